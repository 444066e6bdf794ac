#include "lyrefit/simulate/simulate_module.h"

#include <fmt/format.h>

#include <cstdint>
#include <optional>

#include "lyrefit/base/file.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/read_module.h"
#include "lyrefit/simulate/law_of_report.h"
#include "lyrefit/simulate/simulate_from.h"

namespace lyrefit {

Expected<SimulateOptions> SimulationOf(const NamedParameters& module,
                                       const ConditionOptions& stated) {
  const Translation& at = module.translation;
  const int cells = at.spec.cells_in_series;
  if (module.cells_stated && stated.cells && *stated.cells != cells) {
    return Fail(fmt::format("expected the {} cells in series of the module {}, found {}", cells,
                            module.name, *stated.cells));
  }
  IvCurve curve;
  curve.conditions.cells_in_series = cells;
  curve.conditions.cell_temperature_K = kReferenceTemperature_K;
  curve.conditions.irradiance_W_m2 = kReferenceIrradiance_W_m2;
  TRY(ApplyConditions(stated, &curve));
  const Conditions& conditions = curve.conditions;
  if (!(conditions.irradiance_W_m2 > 0)) {
    return Fail("the law of a module needs light: expected an irradiance above 0 W/m2");
  }
  const TranslatedDevice device =
      TranslateTo(at, module.shared, conditions.irradiance_W_m2, conditions.cell_temperature_K);
  SimulateOptions options;
  options.model = at.spec.model;
  options.constants = at.spec.constants;
  options.conditions = conditions;
  options.recombination = at.recombination >= 0;
  for (int i = 0; i < device.device.size(); ++i) {
    const ParameterInfo& info = device.device.parameters[i];
    // Of a module without a number of cells, n is that of all of them.
    const bool ideality = info.kind == ParameterKind::kIdeality;
    options.parameters[info.symbol] =
        device.parameters[i] * (ideality ? 1.0 * cells / conditions.cells_in_series : 1);
  }
  return options;
}

Expected<SimulateOptions> ReadReportForSimulation(const std::string& text, const std::string& path,
                                                  const std::string& curve,
                                                  const ConditionOptions& stated) {
  if (!curve.empty()) return ReadFitTextForSimulation(text, path, curve);
  TRY(const std::optional<NamedParameters> law, LawOfReport(text, path));
  if (!law) return ReadFitTextForSimulation(text, path, curve);
  if (stated.irradiance_W_m2 && stated.temperature_C) return SimulationOf(*law, stated);
  auto one = ReadFitTextForSimulation(text, path, curve);
  if (one) return one;
  return Fail(one.error().message +
                  "; or state both --irradiance-Wm2 and --temperature-C for the law of all",
              path);
}

Expected<DeviceToSimulate> ReadForSimulation(const std::string& file, const std::string& curve,
                                             const ConditionOptions& stated) {
  DeviceToSimulate device;
  TRY(const bool is_module, HoldsModule(file));
  if (!is_module) {
    constexpr std::uintmax_t kLargestReport = 64U << 20;
    TRY(const std::string text, ReadTextFile(file, kLargestReport));
    TRY(device.options, ReadReportForSimulation(text, file, curve, stated));
    return device;
  }
  if (!curve.empty()) return Fail("a module, which has no curve " + curve + " to choose", file);
  TRY(NamedParameters module, ReadModuleParameters(file));
  TRY(device.options, SimulationOf(module, stated));
  device.warnings = std::move(module.warnings);
  return device;
}

}  // namespace lyrefit
