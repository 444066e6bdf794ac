#include "lyrefit/translate/translate_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/json_text.h"
#include "lyrefit/read/read_module.h"
#include "lyrefit/translate/take_coefficients.h"

namespace lyrefit {

Expected<void> ReadTarget(const std::string& text, TranslateOptions* options, const TextReaders&) {
  constexpr double kLowest_W_m2 = 1, kHighest_W_m2 = 2000, kColdest_C = -60, kHottest_C = 150;
  if (LowerCase(TrimBlanks(text)) == "stc") {
    options->target = TranslationTarget();
    return {};
  }
  const std::size_t comma = text.find(',');
  const auto irradiance = ParseNumber(text.substr(0, comma));
  const auto temperature =
      comma == std::string::npos ? std::nullopt : ParseNumber(text.substr(comma + 1));
  if (!irradiance || !temperature) {
    return Fail(fmt::format(
        "expected irradiance in W/m2 and cell temperature in C such as 1000,25, or STC, found '{}'",
        text));
  }
  if (!(*irradiance >= kLowest_W_m2 && *irradiance <= kHighest_W_m2)) {
    return Fail(fmt::format("expected an irradiance of {} to {} W/m2, found {}", kLowest_W_m2,
                            kHighest_W_m2, *irradiance));
  }
  if (!(*temperature >= kColdest_C && *temperature <= kHottest_C)) {
    return Fail(fmt::format("expected a cell temperature of {} to {} C, found {}", kColdest_C,
                            kHottest_C, *temperature));
  }
  options->target = {*irradiance, *temperature};
  return {};
}

std::vector<std::string> TargetTexts(const TranslateOptions& options) {
  return {NumberText(options.target.irradiance_W_m2) + "," +
          NumberText(options.target.temperature_C)};
}

namespace {

// Takes what options do not say yet from the sheet in a file of another program.
Expected<void> TakeSheet(const std::string& file, TranslateOptions* options) {
  TRY(const ModuleSheet module, ReadModuleSheet(file));
  FieldTestOptions& test = options->field_test;
  const DataSheetValues& values = module.sheet.values;
  StatedCoefficients& stated = options->coefficients;
  if (!test.rated_W) test.rated_W = module.rated_power_W;
  if (!test.power_coefficient_percent_K) {
    test.power_coefficient_percent_K = module.sheet.gamma_pmp_percent_K;
  }
  if (options->technology.empty()) options->technology = module.sheet.technology;
  const auto known = [](double value) { return !std::isnan(value); };
  if (!stated.alpha_A_K && !stated.alpha_percent_K && known(values.alpha_sc_A_K)) {
    stated.alpha_A_K = values.alpha_sc_A_K;
  }
  if (!stated.beta_V_K && !stated.beta_percent_K && known(values.beta_oc_V_K)) {
    stated.beta_V_K = values.beta_oc_V_K;
  }
  return {};
}

}  // namespace

const std::vector<OptionRow<DiagnoseOptions>>& TranslateDiagnosisRows() {
  static const auto* const rows = [] {
    constexpr const char* kNames[] = {"base", "noise", "effects", "seed", "threads"};
    auto* chosen = new std::vector<OptionRow<DiagnoseOptions>>();
    for (const char* name : kNames) {
      std::copy_if(std::begin(kDiagnoseOptionTable), std::end(kDiagnoseOptionTable),
                   std::back_inserter(*chosen),
                   [name](const auto& row) { return row.name == std::string(name); });
    }
    return chosen;
  }();
  return *rows;
}

void ShareSeedAndThreads(TranslateOptions* options) {
  options->uncertainty.seed = options->diagnosis.seed;
  options->uncertainty.threads = options->diagnosis.threads;
}

Expected<void> ReadModule(const std::string& path, TranslateOptions* options) {
  TRY(options->layout, ReadDeviceLayout(path));
  TRY(const bool other, HoldsModule(path));
  if (other) return TakeSheet(path, options);
  TRY(const ModuleJson module, ReadModuleJson(path));
  const JsonFields fields(module.json, module.text, path);
  FieldTestOptions& test = options->field_test;
  TRY(const auto rated_W, fields.Number({"rated_power_W"}));
  TRY(const auto gamma, fields.Number({"gamma_pmp_percent_K"}));
  TRY(const auto technology, fields.Text("technology"));
  if (!test.rated_W) test.rated_W = rated_W;
  if (!test.power_coefficient_percent_K) test.power_coefficient_percent_K = gamma;
  if (options->technology.empty()) options->technology = technology.value_or("");
  return TakeCoefficients(module.json, module.text, path, &options->coefficients);
}

Expected<void> ValidateTranslateOptions(const TranslateOptions& options) {
  constexpr double kMostPerKelvin = 1000;
  TRY(ValidateOptions(options, kTranslateOptionTable));
  TRY(ValidateOptions(options.uncertainty, kUncertaintyOptionTable));
  TRY(ValidateOptions(options.field_test, kFieldTestOptionTable));
  TRY(ValidateOptions(options.checklist, kChecklistOptionTable));
  TRY(ValidateOptions(options.coefficients, kCoefficientTable));
  const StatedCoefficients& c = options.coefficients;
  if (options.rear_irradiance_W_m2 > 0 && options.bifaciality_isc == 0) {
    return Fail(
        "irradiance of the back counts by the bifaciality of the module: say --bifaciality too");
  }
  for (const auto& [name, value] :
       {std::pair{"alpha", c.alpha_A_K}, {"alpha", c.alpha_percent_K}, {"beta", c.beta_V_K}}) {
    if (!value || std::fabs(*value) <= kMostPerKelvin) continue;
    return Fail(fmt::format("{} of {:g} per kelvin is of no device", name, *value));
  }
  if (c.beta_percent_K && !(std::fabs(*c.beta_percent_K) < 2)) {
    return Fail(fmt::format("beta of {:g} %/K is of no device", *c.beta_percent_K));
  }
  return {};
}

}  // namespace lyrefit
