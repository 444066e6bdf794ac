#include "lyrefit/devices/stated_sheet.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/try.h"
#include "lyrefit/family/family_documents.h"
#include "lyrefit/model/pvlib_parameters.h"
#include "lyrefit/read/read_module.h"

namespace lyrefit {
namespace {

// A printed value among the options.
struct PrintedOption {
  const char* flag;
  std::string StatedSheet::*text;
  double DataSheetValues::*field;
  double DataSheetValues::*whole;  // base of a percentage; null: none
};
constexpr PrintedOption kPrintedTable[] = {
    {"--isc", &StatedSheet::isc, &DataSheetValues::short_circuit_current_A, nullptr},
    {"--voc", &StatedSheet::voc, &DataSheetValues::open_circuit_voltage_V, nullptr},
    {"--imp", &StatedSheet::imp, &DataSheetValues::max_power_current_A, nullptr},
    {"--vmp", &StatedSheet::vmp, &DataSheetValues::max_power_voltage_V, nullptr},
    {"--alpha", &StatedSheet::alpha, &DataSheetValues::alpha_sc_A_K,
     &DataSheetValues::short_circuit_current_A},
    {"--beta", &StatedSheet::beta, &DataSheetValues::beta_oc_V_K,
     &DataSheetValues::open_circuit_voltage_V}};

// Parses `text` given to `flag`. A value with a percent sign is relative to `whole`, if that is
// given.
Expected<PrintedValue> ParsePrinted(const char* flag, const std::string& text, double whole = 0) {
  Expected<PrintedValue> printed = ReadPrintedValue(text, whole);
  if (!printed) return Fail(fmt::format("{}: {}", flag, printed.error().message));
  return printed;
}

// The sheet of the file, or an empty one.
Expected<ModuleSheet> SheetOfFile(const StatedSheet& stated) {
  if (!stated.file.empty()) return ReadModuleSheet(stated.file);
  ModuleSheet module;
  for (const auto& row : kPrintedTable) module.sheet.values.*row.field = kUnknown;
  module.sheet.cells_in_series = 0;
  return module;
}

Error Missing(const StatedSheet& stated, const char* flag) {
  if (stated.file.empty()) return {fmt::format("{} is required: no file states it", flag), {}};
  return {fmt::format("the file does not state the value: say {}", flag), stated.file};
}

Expected<ModuleSheet> Complete(const StatedSheet& stated) {
  TRY(ModuleSheet module, SheetOfFile(stated));
  DataSheet& sheet = module.sheet;
  for (const auto& row : kPrintedTable) {
    double& value = sheet.values.*row.field;
    const std::string& text = stated.*row.text;
    if (!text.empty()) {
      const double whole = row.whole == nullptr ? 0 : sheet.values.*row.whole;
      TRY(const PrintedValue printed, ParsePrinted(row.flag, text, whole));
      value = printed.value;
      sheet.half_unit.*row.field = printed.half_unit;
    }
    if (std::isnan(value)) return tl::unexpected(Missing(stated, row.flag));
  }
  sheet.cells_in_series = stated.cells.value_or(sheet.cells_in_series);
  if (sheet.cells_in_series == 0) return tl::unexpected(Missing(stated, "--cells"));
  if (stated.exact) sheet.half_unit = DataSheetValues();
  if (!stated.name.empty()) module.name = stated.name;
  if (!stated.technology.empty()) sheet.technology = stated.technology;
  if (stated.EgRef_eV) sheet.EgRef_eV = stated.EgRef_eV;
  if (stated.dEgdT_1_K) sheet.dEgdT_1_K = stated.dEgdT_1_K;
  if (module.name.empty()) module.name = "module";
  if (stated.gamma.empty()) return module;
  TRY(const PrintedValue gamma, ParsePrinted("--gamma", stated.gamma, 100));
  constexpr double kMost = 5;  // in size: of no cell
  if (!(std::fabs(gamma.value) <= kMost)) {
    return Fail(fmt::format("--gamma: {} %/K is of no device", stated.gamma));
  }
  sheet.gamma_pmp_percent_K = gamma.value;
  return module;
}

}  // namespace

Expected<FittedSheet> FitStatedSheet(const StatedSheet& stated) {
  TRY(ModuleSheet module, Complete(stated));
  TRY(DataSheetFit fit, FitDataSheet(module.sheet, stated.constants));
  for (const std::string& assumption : module.assumptions) fit.warnings.push_back(assumption);
  if (module.has_model && !(fit.Solved() && fit.usual)) {
    fit.warnings.push_back(fmt::format(
        "the file states a device of its own, with its series and shunt resistance and ideality: "
        "lyrefit simulate --from '{}' takes that",
        stated.file));
  }
  return FittedSheet{std::move(module), std::move(fit)};
}

Expected<std::string> PvlibText(const FittedSheet& sheet) {
  const auto& [module, fit] = sheet;
  TRY(const auto keywords, PvlibParameters(fit.translation, fit.shared));
  const auto row = CecRow(fit.translation, fit.shared, module.name, module.sheet.technology);
  return PvlibJson(module.name, fit.translation.spec.law, keywords, row);
}

}  // namespace lyrefit
