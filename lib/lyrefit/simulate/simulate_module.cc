#include "lyrefit/simulate/simulate_module.h"

#include <fmt/format.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>

#include "lyrefit/base/file.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/json_text.h"
#include "lyrefit/read/read_module.h"
#include "lyrefit/simulate/simulate_from.h"

namespace lyrefit {
namespace {

using nlohmann::json;

// The text of a key; empty: none.
std::string ReportText(const json& report, const char* key) {
  const auto at = report.find(key);
  return at != report.end() && at->is_string() ? at->get<std::string>() : std::string();
}

// What the report states of its law; empty: it is not of one law, or of one with effects.
std::optional<TranslationSpec> SpecOfReport(const json& report) {
  const auto law = FromText<TranslationLaw>(ReportText(report, "family"));
  const auto model = FromText<Model>(ReportText(report, "model"));
  const auto shunt = FromText<ShuntLaw>(ReportText(report, "shunt"));
  const auto constants = FromText<ConstantSet>(ReportText(report, "constants"));
  const json cells = report.value("cells_in_series", json());
  const bool plain = report.value("causes", json::array()).empty();
  if (!law || !model || !shunt || !constants || !cells.is_number_integer() || !plain) {
    return std::nullopt;
  }
  TranslationSpec spec;
  spec.law = *law;
  spec.model = *model;
  spec.shunt = *shunt;
  spec.constants = *constants;
  spec.cells_in_series = cells.get<int>();
  spec.recombination = report.value("recombination", json()) == true;
  return spec;
}

// The law and the shared parameters of a family's JSON report. Empty: the report is of another kind,
// of individual fits, or its law has effects, which belong to single curves. `path`: for errors. Errors:
// not JSON; a parameter of the law that is missing or no number.
Expected<std::optional<NamedParameters>> LawOfReport(const std::string& text,
                                                     const std::string& path) {
  TRY(const json report, ParseJson(text, path));
  if (!report.is_object() || !report.value("parameters", json()).is_object()) return std::nullopt;
  const std::optional<TranslationSpec> spec = SpecOfReport(report);
  if (!spec) return std::nullopt;
  NamedParameters law;
  law.name = path;
  TRY(law.translation, MakeTranslation(*spec));
  for (const ParameterInfo& info : law.translation.parameters) {
    const json stated = report["parameters"].value(info.name, json::object());
    // The refined value, or the searched one without a polish; null is a perfect shunt.
    json value = stated.value("refined", json());
    if (!value.is_number()) value = stated.value("searched", json());
    const bool shunt = info.kind == ParameterKind::kShunt || info.kind == ParameterKind::kDarkShunt;
    if (!value.is_number() && !(shunt && stated.contains("refined"))) {
      return Fail("expected a number in parameters/" + info.name + "/refined", path);
    }
    law.shared.push_back(value.is_number() ? value.get<double>() : kInfinity);
  }
  return law;
}

}  // namespace

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
