#include "lyrefit/read/write_curve.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "lyrefit/read/json_text.h"

namespace lyrefit {
namespace {

// Temperature in degrees Celsius that converts back to the same kelvin, rounded to 1e-9 if
// possible.
double Celsius(double temperature_K) {
  const double exact = temperature_K - kZeroCelsius_K;
  const double rounded = std::round(exact * 1e9) / 1e9;
  if (rounded + kZeroCelsius_K == temperature_K) return rounded;
  return exact;
}

void AddNotes(const DeviceNotes& notes, nlohmann::ordered_json* sidecar) {
  const auto add = [&](const char* key, const auto& value) {
    if (value) (*sidecar)[key] = *value;
  };
  if (!notes.technology.empty()) (*sidecar)["technology"] = notes.technology;
  if (notes.setup != Setup::kUnknown) (*sidecar)["setup"] = ToText(notes.setup);
  add("bypass_diodes", notes.bypass_diodes);
  add("modules_in_series", notes.modules_in_series);
  add("bandgap_eV", notes.bandgap_eV);
  add("bandgap_slope_per_K", notes.bandgap_slope_per_K);
  add("isc_tempco_per_K", notes.isc_tempco_per_K);
  add("isc_tempco_A_per_K", notes.isc_tempco_A_per_K);
  if (notes.current_noise_constant_A) {
    (*sidecar)["current_noise"]["constant_A"] = *notes.current_noise_constant_A;
  }
  if (notes.current_noise_relative) {
    (*sidecar)["current_noise"]["relative"] = *notes.current_noise_relative;
  }
  add("current_resolution_A", notes.current_resolution_A);
  add("area_cm2", notes.area_cm2);
  add("compliance_A", notes.compliance_A);
  add("scan_rate_V_s", notes.scan_rate_V_s);
  add("elapsed_h", notes.elapsed_h);
  add("light_top", notes.light_top);
  add("light_bottom", notes.light_bottom);
  if (!notes.date.empty()) (*sidecar)["date"] = notes.date;
}

}  // namespace

std::string CurveToCsv(const IvCurve& curve) {
  std::vector<std::pair<const char*, const std::vector<double>*>> columns = {
      {"voltage_V", &curve.voltage_V}, {"current_A", &curve.current_A}};
  if (!curve.sigma_A.empty()) columns.emplace_back("sigma_A", &curve.sigma_A);
  if (!curve.time_s.empty()) columns.emplace_back("time_s", &curve.time_s);
  if (!curve.irradiance_W_m2.empty()) {
    columns.emplace_back("irradiance_Wm2", &curve.irradiance_W_m2);
  }
  if (!curve.temperature_C.empty()) columns.emplace_back("temperature_C", &curve.temperature_C);

  std::string text;
  auto out = std::back_inserter(text);
  for (const auto& [name, values] : columns) {
    fmt::format_to(out, "{}{}", text.empty() ? "" : ",", name);
  }
  text += curve.sweep.empty() ? "\n" : ",sweep\n";
  for (std::size_t i = 0; i < curve.size(); ++i) {
    for (const auto& [name, values] : columns) {
      // Without a precision fmt writes the shortest text that reads back to the same bits.
      fmt::format_to(out, "{}{}", values == &curve.voltage_V ? "" : ",", (*values)[i]);
    }
    if (!curve.sweep.empty()) fmt::format_to(out, ",{}", curve.sweep[i]);
    text += '\n';
  }
  return text;
}

std::string CurveSidecarJson(const IvCurve& curve) {
  nlohmann::ordered_json sidecar;
  if (!curve.name.empty()) sidecar["name"] = curve.name;
  sidecar["cells_in_series"] = curve.conditions.cells_in_series;
  sidecar["strings_in_parallel"] = curve.conditions.strings_in_parallel;
  sidecar["nominal_temperature_C"] = Celsius(curve.conditions.cell_temperature_K);
  sidecar["nominal_irradiance_Wm2"] = curve.conditions.irradiance_W_m2;
  AddNotes(curve.notes, &sidecar);
  return Dump(sidecar);
}

}  // namespace lyrefit
