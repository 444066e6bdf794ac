#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/model/device_effects.h"
#include "lyrefit/read/json_text.h"
#include "lyrefit/report/json.h"

// Conversion of records to JSON: a function to_json for each record, which nlohmann finds by type
// for members, lists and optionals. Numbers that are not finite and empty optionals are null; an
// enumeration is its text.
namespace nlohmann {

template <class T>
struct adl_serializer<std::optional<T>> {
  template <class J>
  static void to_json(J& json, const std::optional<T>& value) {
    if (value) {
      json = *value;
    } else {
      json = nullptr;
    }
  }
};

template <class E>
struct adl_serializer<
    E, std::enable_if_t<std::is_enum_v<E>, std::void_t<decltype(lyrefit::EnumTable<E>::kRows)>>> {
  template <class J>
  static void to_json(J& json, E value) {
    json = lyrefit::ToText(value);
  }
};

}  // namespace nlohmann

// Puts fields of a record under their names into `json`.
#define LYREFIT_PUT_FIELDS(json, record, ...)                                \
  do {                                                                       \
    Json& nlohmann_json_j = json;                                            \
    const auto& nlohmann_json_t = record;                                    \
    NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_TO, __VA_ARGS__)) \
  } while (false)

// Defines to_json of a record whose keys are the names of its fields.
#define LYREFIT_JSON_FIELDS(Record, ...) \
  void to_json(Json& j, const Record& record) { LYREFIT_PUT_FIELDS(j, record, __VA_ARGS__); }

namespace lyrefit {

using Json = nlohmann::ordered_json;

// json.cc: parts of several records.
void to_json(Json& j, const IvCurve& curve);  // name, source, conditions and assumptions
void to_json(Json& j, const OptionEcho& option);
void to_json(Json& j, const ParameterInfo& info);
void to_json(Json& j, const Estimate& estimate);
void to_json(Json& j, const Ranged& record);
void to_json(Json& j, const RmsePair& record);
void to_json(Json& j, const KeyPoints& record);
void to_json(Json& j, const Correlation& record);
void to_json(Json& j, const ResidualStatistics& record);  // all but the largest error
void to_json(Json& j, const ErrorReport& errors);
void to_json(Json& j, const RefineReport& refine);
void to_json(Json& j, const TracePoint& point);

// A parameter of an effect, with the effect's own names for it.
Json EffectParameterJson(const std::string& effect, const std::string& symbol,
                         const std::string& name, const std::string& unit);

Json LargestErrorJson(const ResidualStatistics& residuals);
Json SearchJson(const SearchOptions& options, const SearchSummary& search,
                std::int64_t curve_evaluations);

// Temperature rounded to 1e-9, which hides a subtraction residue such as 33.00000000000006.
double RoundCelsius(double celsius);

// Effects and the measured curves that they act in, sufficient to simulate each curve. `shared`:
// the law of all curves; nullptr: each curve has its own.
Json SetLawJson(const std::vector<EffectUse>& with, const CurveSet& set,
                const DeviceEffects* shared);

// json.cc
Json FitJson(const FitReport& report, JsonPoints points);

}  // namespace lyrefit
