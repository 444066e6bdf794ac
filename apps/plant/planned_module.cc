#include "plant/planned_module.h"

#include <cmath>
#include <filesystem>
#include <utility>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/try.h"
#include "lyrefit/devices/data_sheet.h"
#include "lyrefit/read/json_text.h"
#include "lyrefit/read/read_module.h"

namespace lyrefit {
namespace {

// A sheet, and what only JSON states.
struct SheetOfPlan {
  ModuleSheet module;
  std::optional<int> bypass_diodes;
};

// A coefficient that is stated per kelvin or in percent of `whole` per kelvin.
Expected<double> CoefficientIn(const JsonFields& fields, const char* absolute, const char* percent,
                               double whole) {
  TRY(const auto per_kelvin, fields.Number({absolute}));
  if (per_kelvin) return *per_kelvin;
  TRY(const auto part, fields.Number({percent}));
  return part ? *part / 100 * whole : kUnknown;
}

Expected<SheetOfPlan> ReadJsonSheetOf(const std::string& file) {
  TRY(const ModuleJson json, ReadModuleJson(file));
  const JsonFields fields(json.json, json.text, file);
  SheetOfPlan found;
  DataSheetValues& values = found.module.sheet.values;
  const std::pair<const char*, double*> needed[] = {
      {"short_circuit_current_A", &values.short_circuit_current_A},
      {"open_circuit_voltage_V", &values.open_circuit_voltage_V},
      {"max_power_current_A", &values.max_power_current_A},
      {"max_power_voltage_V", &values.max_power_voltage_V}};
  for (const auto& [key, value] : needed) {
    TRY(const auto number, fields.Number({key}));
    if (!number) return Fail(std::string("expected the key \"") + key + "\" of a module", file);
    *value = *number;
  }
  TRY(values.alpha_sc_A_K,
      CoefficientIn(fields, "alpha_sc_A_K", "alpha_sc_percent_K", values.short_circuit_current_A));
  TRY(values.beta_oc_V_K,
      CoefficientIn(fields, "beta_oc_V_K", "beta_oc_percent_K", values.open_circuit_voltage_V));
  TRY(const auto cells, fields.WholeNumber({"cells_in_series", "N_s"}));
  if (!cells) return Fail("expected the key \"cells_in_series\" of a module", file);
  found.module.sheet.cells_in_series = *cells;
  TRY(const auto diodes, fields.WholeNumber({"bypass_diodes"}));
  if (diodes && *diodes < 1) return fields.Refuse("bypass_diodes", "a number from 1 up");
  found.bypass_diodes = diodes;
  TRY(const auto name, fields.Text("name"));
  found.module.name = name.value_or("");
  return found;
}

Expected<SheetOfPlan> ReadAnySheet(const std::string& file) {
  TRY(const bool other, HoldsModule(file));
  if (!other) return ReadJsonSheetOf(file);
  SheetOfPlan found;
  TRY(found.module, ReadModuleSheet(file));
  return found;
}

}  // namespace

Expected<std::shared_ptr<const PlannedModule>> ReadPlannedModule(const std::string& file) {
  TRY(SheetOfPlan found, ReadAnySheet(file));
  DataSheet& sheet = found.module.sheet;
  // Sheets without coefficients are silicon's: 0.05 and -0.3 % per kelvin.
  DataSheetValues& values = sheet.values;
  if (!std::isfinite(values.alpha_sc_A_K)) {
    values.alpha_sc_A_K = 5e-4 * values.short_circuit_current_A;
  }
  if (!std::isfinite(values.beta_oc_V_K)) {
    values.beta_oc_V_K = -3e-3 * values.open_circuit_voltage_V;
  }
  const auto fit = FitDataSheet(sheet);
  if (!fit) return Fail(fit.error().message, file);
  auto module = std::make_shared<PlannedModule>();
  module->name =
      found.module.name.empty() ? std::filesystem::path(file).stem().string() : found.module.name;
  module->cells_in_series = sheet.cells_in_series;
  module->bypass_diodes = found.bypass_diodes.value_or(3);
  module->translation = fit->translation;
  module->shared = fit->shared;
  return module;
}

}  // namespace lyrefit
