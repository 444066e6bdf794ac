#include "lyrefit/read/sidecar.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "lyrefit/base/append.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/json_text.h"
#include "lyrefit/read/settle_conditions.h"
#include "lyrefit/read/text_encoding.h"

namespace lyrefit {
namespace {

using nlohmann::json;

constexpr const char* kKnownKeys[] = {"name",
                                      "technology",
                                      "setup",
                                      "cell_temperature_C",
                                      "temperature_C",
                                      "nominal_temperature_C",
                                      "irradiance_W_m2",
                                      "irradiance_Wm2",
                                      "nominal_irradiance_Wm2",
                                      "nominal_irradiance_W_m2",
                                      "cells_in_series",
                                      "strings_in_parallel",
                                      "bypass_diodes",
                                      "modules_in_series",
                                      "bandgap_eV",
                                      "EgRef",
                                      "bandgap_slope_per_K",
                                      "dEgdT",
                                      "isc_tempco_per_K",
                                      "isc_tempco_A_per_K",
                                      "alpha_Isc_A_per_K",
                                      "current_resolution_A",
                                      "current_noise",
                                      "area_cm2",
                                      "compliance_A",
                                      "scan_rate_V_s",
                                      "elapsed_h",
                                      "light_top",
                                      "light_bottom",
                                      "date"};

// A text that states that an entry has no single value.
constexpr const char* kVaried = "varied";

enum class Sign {
  kAny,
  kLight,  // from 0 up, or what a sensor shows at night
  kNotNegative,
  kPositive
};

// State while a sidecar is read; only the first error is kept.
struct SidecarReading {
  JsonFields fields;
  const std::string& text;
  const std::string& path;
  SidecarOf of;
  Sidecar sidecar;
  bool failed = false;
  Error error;
};

void Refuse(SidecarReading* reading, const Error& error) {
  if (!reading->failed) reading->error = error;
  reading->failed = true;
}

// "\"cell_temperature_C\" of string.json"
std::string SourceOf(const SidecarReading& reading, const std::string& key) {
  return fmt::format("\"{}\" of {}", key, std::filesystem::path(reading.path).filename().string());
}

void ReadText(SidecarReading* reading, const char* key, std::string* target,
              std::string* source = nullptr) {
  const auto text = reading->fields.Text(key);
  if (!text) return Refuse(reading, text.error());
  if (!*text) return;
  *target = **text;
  if (source != nullptr) *source = SourceOf(*reading, key);
}

void ReadNumber(SidecarReading* reading, const JsonFields& fields,
                std::initializer_list<const char*> keys, Sign sign, std::optional<double>* target) {
  std::string key;
  const json* value = fields.Find(keys, &key);
  if (value == nullptr) return;
  if (value->is_string() && value->get_ref<const std::string&>() == kVaried) return;
  const auto number = fields.Number(keys);
  if (!number) return Refuse(reading, number.error());
  if (sign == Sign::kPositive && !(**number > 0)) {
    return Refuse(reading, fields.Refuse(key, "a positive number").value());
  }
  const double least = sign == Sign::kLight ? -kLargestDarkOffset_W_m2 : 0;
  if ((sign == Sign::kNotNegative || sign == Sign::kLight) && !(**number >= least)) {
    return Refuse(reading, fields.Refuse(key, "a number from 0 up").value());
  }
  *target = *number;
}

void ReadNumber(SidecarReading* reading, std::initializer_list<const char*> keys, Sign sign,
                std::optional<double>* target) {
  ReadNumber(reading, reading->fields, keys, sign, target);
}

void ReadWhole(SidecarReading* reading, const char* key, int smallest, const char* expected,
               std::optional<int>* target, std::string* source = nullptr) {
  const auto number = reading->fields.WholeNumber({key});
  if (!number) return Refuse(reading, number.error());
  if (!*number) return;
  if (**number < smallest) return Refuse(reading, reading->fields.Refuse(key, expected).value());
  *target = *number;
  if (source != nullptr) *source = SourceOf(*reading, key);
}

// Whether a value is a remark. A text that begins like a number ("25 C") is more likely a mistake.
bool IsRemark(const json& value) {
  if (!value.is_string()) return false;
  const auto& text = value.get_ref<const std::string&>();
  return !text.empty() && text.find_first_of("+-.0123456789 ") != 0;
}

// Reads the first key of `keys` that is present; in a set, remarks are skipped.
void ReadCondition(SidecarReading* reading, std::initializer_list<const char*> keys, Sign sign,
                   std::optional<double>* target, std::string* source) {
  for (const char* key : keys) {
    std::string name;
    const json* value = reading->fields.Find({key}, &name);
    if (value == nullptr || (reading->of == SidecarOf::kSet && IsRemark(*value))) continue;
    *source = SourceOf(*reading, name);
    return ReadNumber(reading, reading->fields, {key}, sign, target);
  }
}

void ReadConditionKeys(SidecarReading* reading) {
  const auto temperature_keys = {"cell_temperature_C", "temperature_C", "nominal_temperature_C"};
  ReadCondition(reading, temperature_keys, Sign::kAny, &reading->sidecar.temperature_C,
                &reading->sidecar.stated_in.temperature);
  const double temperature_C = reading->sidecar.temperature_C.value_or(25);
  if (temperature_C > 150 || temperature_C < -100) {
    std::string key;
    reading->fields.Find(temperature_keys, &key);
    Refuse(reading, reading->fields
                        .Refuse(key, temperature_C > 150
                                         ? "degrees Celsius from -100 to 150 (it looks like kelvin)"
                                         : "degrees Celsius from -100 to 150")
                        .value());
  }
  ReadCondition(
      reading,
      {"irradiance_W_m2", "irradiance_Wm2", "nominal_irradiance_Wm2", "nominal_irradiance_W_m2"},
      Sign::kLight, &reading->sidecar.irradiance_W_m2, &reading->sidecar.stated_in.irradiance);
  ReadWhole(reading, "cells_in_series", 1, "at least 1", &reading->sidecar.cells_in_series,
            &reading->sidecar.stated_in.cells);
  ReadWhole(reading, "strings_in_parallel", 1, "at least 1", &reading->sidecar.strings_in_parallel);
  ReadWhole(reading, "modules_in_series", 1, "at least 1",
            &reading->sidecar.notes.modules_in_series);
}

void ReadNoise(SidecarReading* reading) {
  std::string key;
  const json* noise = reading->fields.Find({"current_noise"}, &key);
  if (noise == nullptr) return;
  if (!noise->is_object()) {
    return Refuse(reading,
                  reading->fields.Refuse(key, "an object of constant_A and relative").value());
  }
  const JsonFields fields(*noise, reading->text, reading->path);
  ReadNumber(reading, fields, {"constant_A"}, Sign::kNotNegative,
             &reading->sidecar.notes.current_noise_constant_A);
  ReadNumber(reading, fields, {"relative"}, Sign::kNotNegative,
             &reading->sidecar.notes.current_noise_relative);
}

Expected<Sidecar> ReadKeys(SidecarReading* reading) {
  ReadText(reading, "name", &reading->sidecar.name);
  ReadText(reading, "technology", &reading->sidecar.notes.technology,
           &reading->sidecar.stated_in.technology);
  ReadConditionKeys(reading);
  DeviceNotes& notes = reading->sidecar.notes;
  std::string setup;
  ReadText(reading, "setup", &setup, &reading->sidecar.stated_in.setup);
  notes.setup = FromText<Setup>(setup).value_or(FindSetup(setup));
  ReadWhole(reading, "bypass_diodes", 0, "a number from 0 up", &notes.bypass_diodes,
            &reading->sidecar.stated_in.bypass_diodes);
  ReadNumber(reading, {"bandgap_eV", "EgRef"}, Sign::kPositive, &notes.bandgap_eV);
  ReadNumber(reading, {"bandgap_slope_per_K", "dEgdT"}, Sign::kAny, &notes.bandgap_slope_per_K);
  ReadNumber(reading, {"isc_tempco_per_K"}, Sign::kAny, &notes.isc_tempco_per_K);
  ReadNumber(reading, {"isc_tempco_A_per_K", "alpha_Isc_A_per_K"}, Sign::kAny,
             &notes.isc_tempco_A_per_K);
  ReadNumber(reading, {"current_resolution_A"}, Sign::kPositive, &notes.current_resolution_A);
  ReadNumber(reading, {"area_cm2"}, Sign::kPositive, &notes.area_cm2);
  ReadNumber(reading, {"compliance_A"}, Sign::kPositive, &notes.compliance_A);
  ReadNumber(reading, {"scan_rate_V_s"}, Sign::kPositive, &notes.scan_rate_V_s);
  ReadNumber(reading, {"elapsed_h"}, Sign::kNotNegative, &notes.elapsed_h);
  ReadNumber(reading, {"light_top"}, Sign::kNotNegative, &notes.light_top);
  ReadNumber(reading, {"light_bottom"}, Sign::kNotNegative, &notes.light_bottom);
  ReadText(reading, "date", &notes.date);
  ReadNoise(reading);
  if (reading->failed) return tl::unexpected(reading->error);
  return reading->sidecar;
}

// The conditions in a report, and those among them that the report assumed.
struct StatedConditions {
  const json& values;
  json assumed;                  // its list of assumed keys
  bool nothing_assumed = false;  // used if there is no such list
};

std::optional<double> Number(const StatedConditions& conditions, const char* key, double low,
                             double high) {
  const json& assumed = conditions.assumed;
  const bool stated = assumed.is_array()
                          ? std::find(assumed.begin(), assumed.end(), key) == assumed.end()
                          : conditions.nothing_assumed;
  const auto value = conditions.values.find(key);
  if (!stated || value == conditions.values.end() || !value->is_number()) return std::nullopt;
  const double number = value->get<double>();
  return number >= low && number <= high ? std::optional<double>(number) : std::nullopt;
}

std::optional<int> Count(const StatedConditions& conditions, const char* key) {
  const std::optional<double> number = Number(conditions, key, 1, 1e6);
  return number ? std::optional<int>(static_cast<int>(*number)) : std::nullopt;
}

}  // namespace

Expected<Sidecar> ReadSidecar(const std::string& path, std::uintmax_t largest_file_bytes,
                              SidecarOf of) {
  TRY(const DecodedText decoded, ReadDecodedFile(path, largest_file_bytes));
  const Expected<json> object = ParseJson(decoded.text, path);
  if (!object) return tl::unexpected(object.error());
  if (!object->is_object())
    return Fail("expected a JSON object with keys such as cells_in_series", path, 1, 1);
  if (IsReport(*object)) {
    if (auto conditions = ReportedConditions(*object, path)) return *conditions;
    return Fail(
        "this is a report of lyrefit, not a sidecar, and states no conditions of one "
        "curve: move it to another name",
        path);
  }
  SidecarReading reading{
      JsonFields(*object, decoded.text, path), decoded.text, path, of, {}, false, {}};
  Expected<Sidecar> sidecar = ReadKeys(&reading);
  const bool known = std::any_of(std::begin(kKnownKeys), std::end(kKnownKeys),
                                 [&](const char* key) { return object->contains(key); });
  if (sidecar && !known) {
    sidecar->assumptions.push_back(
        fmt::format("{} has none of the keys of a sidecar (cells_in_series, cell_temperature_C, "
                    "irradiance_W_m2, ...): nothing was taken from it",
                    std::filesystem::path(path).filename().string()));
  }
  return sidecar;
}

Expected<Sidecar> SidecarOfKeys(const json& object, const std::string& path) {
  const std::string text;  // no text, so errors carry no position
  SidecarReading reading{
      JsonFields(object, text, path), text, path, SidecarOf::kCurve, {}, false, {}};
  return ReadKeys(&reading);
}

bool IsSidecarKey(std::string_view key) {
  return std::any_of(std::begin(kKnownKeys), std::end(kKnownKeys),
                     [&](const char* known) { return key == known; });
}

bool IsReport(const json& document) {
  return document.is_object() && document.contains("lyrefit_version");
}

std::optional<Sidecar> ReportedConditions(const json& report, const std::string& path) {
  const auto curve = report.find("curve");
  if (curve == report.end() || !curve->is_object()) return std::nullopt;
  const auto found = curve->find("conditions");
  if (found == curve->end() || !found->is_object()) return std::nullopt;
  const StatedConditions stated{*found, curve->value("assumed", json()),
                                curve->value("assumptions", json::array()).empty()};
  Sidecar sidecar;
  const auto name = curve->find("name");
  if (name != curve->end() && name->is_string()) sidecar.name = name->get<std::string>();
  sidecar.cells_in_series = Count(stated, "cells_in_series");
  sidecar.strings_in_parallel = Count(stated, "strings_in_parallel");
  sidecar.temperature_C = Number(stated, "cell_temperature_C", -100, 150);
  sidecar.irradiance_W_m2 = Number(stated, "irradiance_Wm2", 0, kInfinity);
  const bool clear = stated.assumed.is_array() || stated.nothing_assumed;
  sidecar.assumptions.push_back(
      fmt::format("{} is a report of lyrefit, not a sidecar: {}",
                  std::filesystem::path(path).filename().string(),
                  clear ? "the conditions in it were used"
                        : "it does not say which of its conditions it assumed, none was used"));
  return sidecar;
}

void TakeSetup(Setup setup, const std::string& stated_in, Sidecar* sidecar) {
  if (setup == Setup::kUnknown || sidecar->notes.setup != Setup::kUnknown) return;
  sidecar->notes.setup = setup;
  sidecar->stated_in.setup = stated_in;
}

Sidecar Merge(Sidecar own, const Sidecar& common) {
  const auto fill = [](auto* value, const auto& otherwise) {
    if (!*value) *value = otherwise;
  };
  // The same, with where it is stated.
  const auto take = [](auto* value, const auto& otherwise, std::string* source,
                       const std::string& other_source) {
    const std::decay_t<decltype(otherwise)> unstated{};
    if (*value != unstated || otherwise == unstated) return;
    *value = otherwise;
    *source = other_source;
  };
  ConditionSources& in = own.stated_in;
  const ConditionSources& other = common.stated_in;
  if (own.name.empty()) own.name = common.name;
  take(&own.temperature_C, common.temperature_C, &in.temperature, other.temperature);
  take(&own.irradiance_W_m2, common.irradiance_W_m2, &in.irradiance, other.irradiance);
  if (own.light.empty()) own.light = common.light;
  take(&own.cells_in_series, common.cells_in_series, &in.cells, other.cells);
  fill(&own.strings_in_parallel, common.strings_in_parallel);
  DeviceNotes& notes = own.notes;
  take(&notes.technology, common.notes.technology, &in.technology, other.technology);
  take(&notes.setup, common.notes.setup, &in.setup, other.setup);
  take(&notes.bypass_diodes, common.notes.bypass_diodes, &in.bypass_diodes, other.bypass_diodes);
  fill(&notes.modules_in_series, common.notes.modules_in_series);
  fill(&notes.bandgap_eV, common.notes.bandgap_eV);
  fill(&notes.bandgap_slope_per_K, common.notes.bandgap_slope_per_K);
  fill(&notes.isc_tempco_per_K, common.notes.isc_tempco_per_K);
  fill(&notes.isc_tempco_A_per_K, common.notes.isc_tempco_A_per_K);
  fill(&notes.current_noise_constant_A, common.notes.current_noise_constant_A);
  fill(&notes.current_noise_relative, common.notes.current_noise_relative);
  fill(&notes.current_resolution_A, common.notes.current_resolution_A);
  fill(&notes.area_cm2, common.notes.area_cm2);
  fill(&notes.compliance_A, common.notes.compliance_A);
  fill(&notes.scan_rate_V_s, common.notes.scan_rate_V_s);
  fill(&notes.elapsed_h, common.notes.elapsed_h);
  fill(&notes.illuminance_lux, common.notes.illuminance_lux);
  fill(&notes.light_top, common.notes.light_top);
  fill(&notes.light_bottom, common.notes.light_bottom);
  if (notes.date.empty()) notes.date = common.notes.date;
  Append(common.assumptions, &own.assumptions);
  return own;
}

}  // namespace lyrefit
