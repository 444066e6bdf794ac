#include "lyrefit/read/json_curves.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "lyrefit/base/try.h"
#include "lyrefit/curve/sweep_order.h"
#include "lyrefit/read/json_text.h"
#include "lyrefit/read/settle_conditions.h"

namespace lyrefit {
namespace {

using nlohmann::json;

// A file and its current entry.
struct IvCurvesFile {
  const json& document;
  const std::string& path;
  std::string place;
  std::string id;
  std::set<std::string> ids;
};

tl::unexpected<Error> RefuseFile(const std::string& path, const std::string& expected) {
  return Fail("expected " + expected, path);
}

tl::unexpected<Error> RefuseEntry(const std::string& path, const std::string& place,
                                  const std::string& key, const std::string& expected) {
  return RefuseFile(path, fmt::format("{} in {}.{}", expected, place, key));
}

Expected<void> ReadEntryIndex(IvCurvesFile* file, const json& entry, IvCurve* curve) {
  const auto found = entry.find("Index");
  const auto index = found == entry.end() ? std::nullopt : NumberOrText(*found);
  if (!index || *index != std::floor(*index) || std::abs(*index) > 1e9) {
    return RefuseEntry(file->path, file->place, "Index", "a whole number");
  }
  file->id = std::to_string(static_cast<int>(*index));
  curve->name = fmt::format("{}_{}", std::filesystem::path(file->path).stem().string(), file->id);
  return {};
}

Expected<void> ReadNumbers(const std::string& path, const std::string& place, const json& entry,
                           const char* key, std::vector<double>* values) {
  const auto list = entry.find(key);
  if (list == entry.end() || !list->is_array())
    return RefuseEntry(path, place, key, "a list of numbers");
  for (std::size_t i = 0; i < list->size(); ++i) {
    const auto value = NumberOrText((*list)[i]);
    if (!value) return RefuseEntry(path, place, fmt::format("{}[{}]", key, i), "a finite number");
    values->push_back(*value);
  }
  return {};
}

// The setting of the curve's entry, else that of the file; null if neither states it.
json Setting(const json& document, const json& entry, const char* key) {
  for (const json* object : {&entry, &document}) {
    const auto found = object->find(key);
    if (found == object->end() || found->is_null()) continue;
    if (found->is_string() && found->get_ref<const std::string&>().empty()) continue;
    return *found;
  }
  return nullptr;
}

Expected<void> ReadEntryConditions(const IvCurvesFile& file, const json& entry, IvCurve* curve) {
  curve->strings_known = false;
  const json cells = Setting(file.document, entry, "cells_in_series");
  if (cells.is_null()) {
    curve->assumptions.emplace_back(kCellsAssumed, About::kCells);
    curve->cells_known = false;
  } else {
    const auto number = NumberOrText(cells);
    const bool counts = number && *number == std::floor(*number) && *number >= 1 && *number <= 1e6;
    if (!counts) return RefuseFile(file.path, "a whole number from 1 up in \"cells_in_series\"");
    curve->conditions.cells_in_series = static_cast<int>(*number);
  }
  const json temperature = Setting(file.document, entry, "Temperature");
  if (temperature.is_null()) {
    curve->assumptions.emplace_back(kTemperatureAssumed, About::kTemperature);
    curve->temperature_known = false;
  } else {
    const auto kelvin = NumberOrText(temperature);
    if (!kelvin || *kelvin < 173 || *kelvin > 474) {
      return RefuseEntry(file.path, file.place, "Temperature", "kelvin from 173 to 474");
    }
    curve->conditions.cell_temperature_K = *kelvin;
  }
  const json irradiance = Setting(file.document, entry, "Irradiance");
  if (irradiance.is_null()) {
    curve->assumptions.emplace_back(kIrradianceAssumed, About::kIrradiance);
    curve->irradiance_known = false;
  } else {
    const auto value = NumberOrText(irradiance);
    if (!value || *value < 0)
      return RefuseEntry(file.path, file.place, "Irradiance", "W/m2 from 0 up");
    curve->conditions.irradiance_W_m2 = *value;
  }
  const json material = Setting(file.document, entry, "Material");
  if (material.is_string()) curve->notes.technology = material.get<std::string>();
  SaySources(curve);
  return {};
}

Expected<IvCurve> ReadEntry(IvCurvesFile* file, const json& entry) {
  if (!entry.is_object())
    return RefuseFile(file->path, fmt::format("an object in {}", file->place));
  IvCurve curve;
  curve.source = file->path;
  TRY(ReadEntryIndex(file, entry, &curve));
  for (const auto& [key, values] :
       {std::pair("Voltages", &curve.voltage_V), std::pair("Currents", &curve.current_A)}) {
    TRY(ReadNumbers(file->path, file->place, entry, key, values));
  }
  if (curve.voltage_V.size() != curve.current_A.size()) {
    return RefuseFile(
        file->path, fmt::format("as many Currents as Voltages in {}, found {} and {}", file->place,
                                curve.current_A.size(), curve.voltage_V.size()));
  }
  TRY(ReadEntryConditions(*file, entry, &curve));
  TurnLoadSign(&curve);
  if (auto valid = Validate(curve); !valid) {
    return Fail(file->place + ": " + valid.error().message, file->path);
  }
  return curve;
}

Expected<std::vector<IvCurvesEntry>> ReadEntries(IvCurvesFile* file) {
  const auto list =
      file->document.is_object() ? file->document.find("IV Curves") : file->document.end();
  if (!file->document.is_object() || list == file->document.end()) {
    return RefuseFile(file->path, "an ivcurves file: a JSON object with the key \"IV Curves\"");
  }
  if (!list->is_array() || list->empty())
    return RefuseFile(file->path, "a list of curves in \"IV Curves\"");
  std::vector<IvCurvesEntry> entries;
  for (std::size_t i = 0; i < list->size(); ++i) {
    file->place = fmt::format("\"IV Curves\"[{}]", i);
    file->id = file->place;
    Expected<IvCurve> curve = ReadEntry(file, (*list)[i]);
    if (!file->ids.insert(file->id).second) {
      return RefuseEntry(file->path, file->place, "Index",
                         fmt::format("a number not used before (it is {})", file->id));
    }
    entries.push_back({file->id, std::move(curve)});
  }
  return entries;
}

}  // namespace

bool IsIvCurves(const json& document) {
  return document.is_object() && document.contains("IV Curves");
}

Expected<std::vector<IvCurvesEntry>> ReadIvCurvesEntries(const json& document,
                                                         const std::string& path) {
  IvCurvesFile file{document, path, {}, {}, {}};
  return ReadEntries(&file);
}

}  // namespace lyrefit
