#include "lyrefit/curve/read_ivcurves_json.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "lyrefit/base/try.h"
#include "lyrefit/curve/current_sign.h"
#include "lyrefit/curve/json_text.h"
#include "lyrefit/curve/number_text.h"
#include "lyrefit/curve/settle_conditions.h"
#include "lyrefit/curve/text_encoding.h"

namespace lyrefit {
namespace {

using nlohmann::json;

// One file: the parts of an error that do not change.
class IvCurvesReader {
 public:
  IvCurvesReader(const json& document, const std::string& path)
      : document_(document), path_(path) {}

  Expected<std::vector<IvCurvesEntry>> Read() {
    const auto list = document_.is_object() ? document_.find("IV Curves") : document_.end();
    if (!document_.is_object() || list == document_.end()) {
      return Refuse("an ivcurves file: a JSON object with the key \"IV Curves\"");
    }
    if (!list->is_array() || list->empty()) return Refuse("a list of curves in \"IV Curves\"");
    std::vector<IvCurvesEntry> entries;
    for (std::size_t i = 0; i < list->size(); ++i) {
      place_ = fmt::format("\"IV Curves\"[{}]", i);
      id_ = place_;
      Expected<IvCurve> curve = ReadOne((*list)[i]);
      if (!ids_.insert(id_).second) {
        return RefuseAt("Index", fmt::format("a number not used before (it is {})", id_));
      }
      entries.push_back({id_, std::move(curve)});
    }
    return entries;
  }

 private:
  tl::unexpected<Error> Refuse(const std::string& expected) const {
    return Fail("expected " + expected, path_);
  }

  tl::unexpected<Error> RefuseAt(const std::string& key, const std::string& expected) const {
    return Refuse(fmt::format("{} in {}.{}", expected, place_, key));
  }

  Expected<IvCurve> ReadOne(const json& entry) {
    if (!entry.is_object()) return Refuse(fmt::format("an object in {}", place_));
    IvCurve curve;
    curve.source = path_;
    TRY(ReadIndex(entry, &curve));
    for (const auto& [key, values] :
         {std::pair("Voltages", &curve.voltage_V), std::pair("Currents", &curve.current_A)}) {
      TRY(ReadList(entry, key, values));
    }
    if (curve.voltage_V.size() != curve.current_A.size()) {
      return Refuse(fmt::format("as many Currents as Voltages in {}, found {} and {}", place_,
                                curve.current_A.size(), curve.voltage_V.size()));
    }
    TRY(ReadConditions(entry, &curve));
    TurnLoadSign(&curve);
    if (auto valid = Validate(curve); !valid) {
      return Fail(place_ + ": " + valid.error().message, path_);
    }
    return curve;
  }

  Expected<void> ReadIndex(const json& entry, IvCurve* curve) {
    const auto found = entry.find("Index");
    const auto index = found == entry.end() ? std::nullopt : NumberOrText(*found);
    if (!index || *index != std::floor(*index) || std::abs(*index) > 1e9) {
      return RefuseAt("Index", "a whole number");
    }
    id_ = std::to_string(static_cast<int>(*index));
    curve->name = fmt::format("{}_{}", std::filesystem::path(path_).stem().string(), id_);
    return {};
  }

  Expected<void> ReadList(const json& entry, const char* key, std::vector<double>* values) const {
    const auto list = entry.find(key);
    if (list == entry.end() || !list->is_array()) return RefuseAt(key, "a list of numbers");
    for (std::size_t i = 0; i < list->size(); ++i) {
      const auto value = NumberOrText((*list)[i]);
      if (!value) return RefuseAt(fmt::format("{}[{}]", key, i), "a finite number");
      values->push_back(*value);
    }
    return {};
  }

  // The entry of the curve, else that of the file; null where neither says anything.
  json Setting(const json& entry, const char* key) const {
    for (const json* object : {&entry, &document_}) {
      const auto found = object->find(key);
      if (found == object->end() || found->is_null()) continue;
      if (found->is_string() && found->get_ref<const std::string&>().empty()) continue;
      return *found;
    }
    return nullptr;
  }

  Expected<void> ReadConditions(const json& entry, IvCurve* curve) const {
    const json cells = Setting(entry, "cells_in_series");
    if (cells.is_null()) {
      curve->assumptions.emplace_back(kCellsAssumed, About::kCells);
      curve->cells_known = false;
    } else {
      const auto number = NumberOrText(cells);
      const bool counts =
          number && *number == std::floor(*number) && *number >= 1 && *number <= 1e6;
      if (!counts) return Refuse("a whole number from 1 up in \"cells_in_series\"");
      curve->conditions.cells_in_series = static_cast<int>(*number);
    }
    const json temperature = Setting(entry, "Temperature");
    if (temperature.is_null()) {
      curve->assumptions.emplace_back(kTemperatureAssumed, About::kTemperature);
      curve->temperature_known = false;
    } else {
      const auto kelvin = NumberOrText(temperature);
      if (!kelvin || *kelvin < 173 || *kelvin > 474) {
        return RefuseAt("Temperature", "kelvin from 173 to 474");
      }
      curve->conditions.cell_temperature_K = *kelvin;
    }
    const json irradiance = Setting(entry, "Irradiance");
    if (irradiance.is_null()) {
      curve->assumptions.emplace_back(kIrradianceAssumed, About::kIrradiance);
      curve->irradiance_known = false;
    } else {
      const auto value = NumberOrText(irradiance);
      if (!value || *value < 0) return RefuseAt("Irradiance", "W/m2 from 0 up");
      curve->conditions.irradiance_W_m2 = *value;
    }
    const json material = Setting(entry, "Material");
    if (material.is_string()) curve->notes.technology = material.get<std::string>();
    return {};
  }

  const json& document_;
  const std::string& path_;
  std::string place_;
  std::string id_;
  std::set<std::string> ids_;
};

}  // namespace

bool IsIvCurves(const json& document) {
  return document.is_object() && document.contains("IV Curves");
}

Expected<json> ReadJsonFile(const std::string& path, const ReadOptions& options) {
  TRY(const DecodedText text, ReadDecodedFile(path, options.largest_file_bytes));
  return ParseJson(text.text, path);
}

Expected<std::vector<IvCurvesEntry>> ReadIvCurvesEntries(const json& document,
                                                         const std::string& path) {
  return IvCurvesReader(document, path).Read();
}

Expected<std::vector<IvCurve>> ReadIvCurvesJson(const std::string& path,
                                                const ReadOptions& options) {
  TRY(const json document, ReadJsonFile(path, options));
  TRY(std::vector<IvCurvesEntry> entries, ReadIvCurvesEntries(document, path));
  std::vector<IvCurve> curves;
  for (IvCurvesEntry& entry : entries) {
    if (!entry.curve) return tl::unexpected(entry.curve.error());
    curves.push_back(std::move(*entry.curve));
  }
  return curves;
}

}  // namespace lyrefit
