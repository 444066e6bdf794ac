#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/curve/json_text.h"
#include "lyrefit/law/extension.h"
#include "lyrefit/report/json.h"

// How records become JSON: a function to_json for each record, which nlohmann finds by the record's
// type wherever one stands in another, in a list or in an optional. A number that is not finite is
// written as null, and so is an optional without a value; an enumeration is its text.
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

// The to_json of a record whose keys are the names of these fields.
#define LYREFIT_JSON_FIELDS(Record, ...)                                     \
  void to_json(Json& j, const Record& record) {                              \
    Json& nlohmann_json_j = j;                                               \
    const Record& nlohmann_json_t = record;                                  \
    NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_TO, __VA_ARGS__)) \
  }

namespace lyrefit {

using Json = nlohmann::ordered_json;

// json.cc: what several records hold.
void to_json(Json& j, const IvCurve& curve);  // name, source, conditions and assumptions
void to_json(Json& j, const OptionEcho& option);
void to_json(Json& j, const ParameterInfo& info);
void to_json(Json& j, const Estimate& estimate);
void to_json(Json& j, const RmsePair& record);
void to_json(Json& j, const KeyPoints& record);
void to_json(Json& j, const Correlation& record);
void to_json(Json& j, const ResidualStatistics& record);  // all but the largest error
void to_json(Json& j, const ErrorReport& errors);
void to_json(Json& j, const TracePoint& point);

// What an effect's parameter is, where it is known by the names it has there.
Json EffectParameterJson(const std::string& effect, const std::string& symbol,
                         const std::string& name, const std::string& unit);

Json LargestErrorJson(const ResidualStatistics& residuals);
Json SearchJson(const SearchOptions& options, const SearchSummary& search,
                std::int64_t curve_evaluations);

// Temperatures: rounded where the subtraction from kelvin leaves 33.00000000000006.
double RoundCelsius(double celsius);

// Effects and the measurement of many curves in which they act, so that whoever reads the report
// can simulate each of them. `shared`: one law stands behind all; without it each curve has its
// own.
Json SetLawJson(const std::vector<EffectUse>& with, const CurveSet& set, const Extension* shared);

// json_fit.cc
Json FitJson(const FitReport& report, JsonPoints points);

// json_diagnosis.cc
void to_json(Json& j, const Diagnosis& diagnosis);

}  // namespace lyrefit
