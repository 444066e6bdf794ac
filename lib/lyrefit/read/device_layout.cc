#include "lyrefit/read/device_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "lyrefit/base/file.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/json_text.h"
#include "lyrefit/read/read_module.h"

namespace lyrefit {
namespace {

constexpr std::uintmax_t kLargestSheet = 1U << 20;

// All keys of a sheet, as apps/lyrefit/verbs/batch.md describes them; second names of a key last.
constexpr const char* kKeys[] = {"name",
                                 "technology",
                                 "cells_in_series",
                                 "bypass_diodes",
                                 "modules_in_series",
                                 "rated_power_W",
                                 "short_circuit_current_A",
                                 "open_circuit_voltage_V",
                                 "max_power_current_A",
                                 "max_power_voltage_V",
                                 "alpha_sc_A_K",
                                 "alpha_sc_percent_K",
                                 "beta_oc_V_K",
                                 "beta_oc_percent_K",
                                 "gamma_pmp_percent_K",
                                 "kappa_ohm_K",
                                 "resistance_series_ohm",
                                 "B1",
                                 "B2",
                                 "epsilon_V",
                                 "EgRef_eV",
                                 "dEgdT_1_K",
                                 "mu_gamma_1_K",
                                 "remark"};
constexpr const char* kSecondNames[] = {"N_s",     "alpha_sc", "alpha_Isc_A_per_K",
                                        "beta_oc", "beta_voc", "beta_Voc_V_per_K",
                                        "b1",      "b2",       "EgRef",
                                        "dEgdT",   "mu_gamma", "coefficients"};

bool IsKey(const std::string& key) {
  const auto is = [&key](const char* known) { return key == known; };
  return std::any_of(std::begin(kKeys), std::end(kKeys), is) ||
         std::any_of(std::begin(kSecondNames), std::end(kSecondNames), is);
}

Expected<std::optional<int>> CountIn(const JsonFields& fields,
                                     std::initializer_list<const char*> keys) {
  TRY(const auto count, fields.WholeNumber(keys));
  std::string key;
  if (count && *count < 1) {
    fields.Find(keys, &key);
    return fields.Refuse(key, "a number from 1 up");
  }
  return count;
}

}  // namespace

Expected<ModuleJson> ReadModuleJson(const std::string& file) {
  ModuleJson module;
  TRY(module.text, ReadTextFile(file, kLargestSheet));
  TRY(module.json, ParseJson(module.text, file));
  if (!module.json.is_object()) {
    return Fail("expected a JSON object, the sheet of a module", file, 1, 1);
  }
  const JsonFields fields(module.json, module.text, file);
  for (const auto& [key, value] : module.json.items()) {
    if (IsKey(key)) continue;
    Error error = fields.Refuse(key, "").value();
    error.message = fmt::format("\"{}\" is no key of a module's sheet: expected one of {}", key,
                                fmt::join(kKeys, ", "));
    return tl::unexpected(std::move(error));
  }
  return module;
}

Expected<DeviceLayout> ReadDeviceLayout(const std::string& file) {
  DeviceLayout layout;
  layout.source = std::filesystem::path(file).filename().string();
  TRY(const bool other, HoldsModule(file));
  if (other) {
    TRY(const ModuleSheet module, ReadModuleSheet(file));
    layout.module_cells = module.sheet.cells_in_series;
    return layout;
  }
  TRY(const ModuleJson module, ReadModuleJson(file));
  const JsonFields fields(module.json, module.text, file);
  TRY(layout.module_cells, CountIn(fields, {"cells_in_series", "N_s"}));
  TRY(layout.module_diodes, CountIn(fields, {"bypass_diodes"}));
  TRY(layout.modules_in_series, CountIn(fields, {"modules_in_series"}));
  return layout;
}

bool IsModuleSheet(const std::string& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return false;
  const auto module = ReadModuleJson(file);
  return module && !module->json.empty();
}

void FillLayout(const DeviceLayout& layout, IvCurve* curve) {
  std::optional<int>& own = curve->notes.modules_in_series;
  if (!own) own = layout.modules_in_series;
  const int stated =
      curve->cells_known && layout.module_cells ? curve->conditions.cells_in_series : 0;
  const int whole =
      stated > 0 && stated % *layout.module_cells == 0 ? stated / *layout.module_cells : 1;
  const int modules = own.value_or(whole);
  const bool fits = stated == 0 || stated == modules * *layout.module_cells;
  std::string filled;
  const auto fill = [&](const std::optional<int>& of_module, const char* noun) {
    filled += (filled.empty() ? "" : " and ") +
              Plural(static_cast<std::size_t>(modules) * *of_module, noun);
    return modules * *of_module;
  };
  const bool cells = !curve->cells_known && layout.module_cells;
  const bool diodes = !curve->notes.bypass_diodes && layout.module_diodes && fits;
  if (cells) {
    curve->conditions.cells_in_series = fill(layout.module_cells, "cell");
    curve->cells_known = true;
    Forget(About::kCells, &curve->assumptions);
  }
  if (diodes) curve->notes.bypass_diodes = fill(layout.module_diodes, "bypass diode");
  if (filled.empty()) return;
  std::string of;
  if (modules > 1) {
    of = fmt::format("{} modules of {}, ", modules,
                     cells ? Plural(*layout.module_cells, "cell")
                           : Plural(*layout.module_diodes, "bypass diode"));
  }
  curve->assumptions.emplace_back(fmt::format("{}: {}{}", filled, of, layout.source),
                                  cells ? About::kCells : About::kBypassDiodes);
}

}  // namespace lyrefit
