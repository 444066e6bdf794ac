#include "lyrefit/devices/data_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/append.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/data_sheet_values.h"
#include "lyrefit/curve/technology.h"
#include "lyrefit/devices/data_sheet_parts.h"
#include "lyrefit/family/key_point_solver.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {
namespace {

constexpr int kSolvedValues = 5;  // alpha_sc is copied from the sheet, not solved for
constexpr std::size_t kRangeOfIdeality = 2;
constexpr double kLowestUsualIdeality = 0.9;  // of a junction, with the rounding of beta_oc
constexpr double kHighestUsualIdeality = 2.5;

// The printed values beside the values of the fitted device.
std::vector<DataSheetCheck> ChecksOf(const DataSheet& sheet, const DataSheetFit& fit) {
  const auto points = [&](double temperature_K) {
    const TranslatedDevice at =
        TranslateTo(fit.translation, fit.shared, kReferenceIrradiance_W_m2, temperature_K);
    return ModelKeyPoints(at.device, at.parameters.data());
  };
  const KeyPoints now = points(kReferenceTemperature_K);
  const KeyPoints warm = points(kReferenceTemperature_K + kVocStep_K);
  const TemperatureCoefficients slopes = CoefficientsAtReference(fit.translation, fit.shared);
  DataSheetValues given;
  given.short_circuit_current_A = now.short_circuit_current_A;
  given.open_circuit_voltage_V = now.open_circuit_voltage_V;
  given.max_power_current_A = now.max_power_current_A;
  given.max_power_voltage_V = now.max_power_voltage_V;
  given.beta_oc_V_K = (warm.open_circuit_voltage_V - now.open_circuit_voltage_V) / kVocStep_K;
  given.alpha_sc_A_K = slopes.alpha_sc_A_K;
  std::vector<DataSheetCheck> checks;
  for (const DataSheetRow& row : kDataSheetRows) {
    checks.push_back({row.name, row.unit, sheet.values.*row.value, given.*row.value});
  }
  if (sheet.gamma_pmp_percent_K) {
    checks.push_back({"gamma_pmp", "%/K", *sheet.gamma_pmp_percent_K, slopes.gamma_pmp_percent_K});
  }
  return checks;
}

// What the rounding of the printed values allows.
struct RoundedFits {
  std::vector<DataSheetRange> ranges;  // empty: no rounding is stated
  bool all_solved = true;  // every corner of the rounding intervals has a device of its values
};

// Solves again at every corner of the values' rounding intervals. Where no device has the values of
// a corner, the nearest device is used.
RoundedFits FitRounded(const DataSheet& sheet, ConstantSet constants, const DataSheetFit& fit) {
  const Translation& at = fit.translation;
  RoundedFits found;
  std::vector<DataSheetValues> corners = {sheet.values};
  for (const DataSheetRow& row : kDataSheetRows) {
    const double half = sheet.half_unit.*row.value;
    if (half == 0) continue;
    const std::size_t count = corners.size();
    for (std::size_t k = 0; k < count; ++k) {
      corners.push_back(corners[k]);
      corners[k].*row.value -= half;
      corners.back().*row.value += half;
    }
  }
  if (corners.size() == 1) return found;
  std::vector<std::vector<double>> solutions = {fit.shared};
  for (const DataSheetValues& corner : corners) {
    const bool possible = CheckDataSheetPoints(corner).has_value();
    const auto solution =
        possible ? SolveKeyPoints(corner, sheet.cells_in_series, GapOf(sheet), constants)
                 : std::nullopt;
    found.all_solved = found.all_solved && solution && solution->border == Border::kNone;
    if (solution)
      solutions.push_back(SharedOf(at, solution->device, corner.alpha_sc_A_K, GapOf(sheet)));
  }
  for (const int k :
       {at.photocurrent, at.saturation_current, at.n, at.resistance_series, at.resistance_shunt}) {
    DataSheetRange range{at.parameters[k].name, fit.shared[k], fit.shared[k]};
    for (const std::vector<double>& shared : solutions) {
      range.low = std::min(range.low, shared[k]);
      range.high = std::max(range.high, shared[k]);
    }
    found.ranges.push_back(range);
  }
  return found;
}

// "the band gap 1.121 eV (assumed, that of silicon; another technology may have the values: state
// it, or its gap)"
std::string GapText(const DataSheet& sheet) {
  std::string gap = fmt::format("the band gap {:g} eV", GapOf(sheet).eV);
  if (sheet.EgRef_eV) return gap;
  const Technology* const known = FindTechnology(sheet.technology);
  if (known != nullptr) return fmt::format("{} ({})", gap, known->name);
  return gap +
         " (assumed, that of silicon; another technology may have the values: state it with "
         "--technology, or its gap with --EgRef)";
}

// The gap of an alloy is not known by its name. n goes as the inverse of the gap at 0 K and 3 k T.
std::vector<std::string> WarnOfTheGap(const DataSheet& sheet) {
  const Technology* const known = FindTechnology(sheet.technology);
  if (sheet.EgRef_eV || known == nullptr || std::isnan(known->widest_gap_eV)) return {};
  constexpr double kStep_eV = 0.1;
  const BandGap gap = GapOf(sheet);
  const double at_0_K = gap.eV * (1 - kReferenceTemperature_K * gap.slope_1_K);
  const double thermal_V = ThermalVoltage(kReferenceTemperature_K);
  return {fmt::format(
      "cells of {} have band gaps of {:g} to {:g} eV, of which {:g} eV is taken; each {:g} eV more "
      "lowers n by {:.0f} %: state it (--EgRef)",
      known->name, known->narrowest_gap_eV, known->widest_gap_eV, gap.eV, kStep_eV,
      100 * kStep_eV / (at_0_K + 3 * thermal_V))};
}

bool IsOfAJunction(double n) { return n >= kLowestUsualIdeality && n <= kHighestUsualIdeality; }

// n of the device against that of a junction, which ties Voc, beta_oc, the gap and the number of
// cells to each other: beta_oc = Ns (Voc/Ns - n (Eg(0 K) + 3 k T)) / T.
std::vector<std::string> WarnOfTheDevice(const DataSheet& sheet, const DataSheetFit& fit) {
  constexpr double kGammaMissed = 0.3;  // the law misses that of sound sheets by 15 % at most
  const Translation& at = fit.translation;
  std::vector<std::string> warnings;
  const BandGap gap = GapOf(sheet);
  const int cells = sheet.cells_in_series;
  const double voc = sheet.values.open_circuit_voltage_V,
               thermal_V = at.device.module_thermal_voltage_V;
  const double gap_V = cells * gap.eV * (1 - kReferenceTemperature_K * gap.slope_1_K);
  const int junctions = JunctionsOfSheet(sheet);
  const double n = fit.shared[at.n] / junctions;
  if (!fit.usual) {
    const double of_one = (voc - junctions * (gap_V + 3 * thermal_V)) / kReferenceTemperature_K;
    const double percent = 100 / voc;
    warnings.push_back(fmt::format(
        "n = {:.3g} is {} that of any junction: at {:.3g} V a cell n = 1 and {} give a beta_oc of "
        "{:.3g} %/K, the sheet says {:.3g}; are beta_oc, the number of cells ({}) and the "
        "technology "
        "as stated?",
        fit.shared[at.n], n < 1 ? "below" : "far above", voc / cells, GapText(sheet),
        percent * of_one, percent * sheet.values.beta_oc_V_K, cells));
  }
  const DataSheetCheck& gamma = fit.checks.back();
  if (sheet.gamma_pmp_percent_K && !(std::fabs(gamma.given / gamma.asked - 1) < kGammaMissed)) {
    warnings.push_back(fmt::format(
        "the device has a gamma_pmp of {:.3g} %/K, the sheet says {:.3g}: not all of its "
        "coefficients are of one module, or the band gap is of another technology",
        gamma.given, gamma.asked));
  }
  return warnings;
}

std::vector<std::string> WarnOfTheSolution(const DataSheet& sheet, const KeyPointSolution& solution,
                                           const DataSheetCheck& beta) {
  std::vector<std::string> warnings;
  const char* reason = "";
  if (solution.border == Border::kNoSeriesResistance)
    reason = "Rs would be negative and is set to 0";
  if (solution.border == Border::kPerfectShunt)
    reason = "Rsh would be negative and is set infinite";
  if (solution.border == Border::kIdeality) reason = "no ideality of the diode gives that beta_oc";
  if (solution.border != Border::kNone) {
    warnings.push_back(fmt::format(
        "no physical single diode of {} has all these values: {}; the curve at 25 C is kept, and "
        "beta_oc comes out as {:.4g} V/K instead of {:.4g}",
        GapText(sheet), reason, beta.given, beta.asked));
  }
  if (solution.solutions > 1) {
    warnings.push_back(
        fmt::format("{} devices have all these values: the one with n closest to 1.2 was taken",
                    solution.solutions));
  }
  return warnings;
}

std::vector<std::string> WarnOfTheRounding(const RoundedFits& rounded) {
  std::vector<std::string> warnings = {
      "a data sheet's five numbers determine the five parameters exactly: nothing is left to check "
      "them, fit a measured curve for that"};
  if (!rounded.all_solved) {
    warnings.push_back(
        "within the rounding of the data sheet there are values that no single diode has");
  }
  if (rounded.ranges.empty()) {
    warnings.push_back(
        "Rs and Rsh move widely with the rounding of the data sheet: state the rounding of its "
        "values to see how far");
    return warnings;
  }
  const DataSheetRange &rs = rounded.ranges[3], &rsh = rounded.ranges[4];
  warnings.push_back(fmt::format(
      "the rounding of the data sheet alone moves Rs from {:.4g} to {:.4g} ohm and Rsh from {:.4g} "
      "to {:.4g} ohm",
      rs.low, rs.high, rsh.low, rsh.high));
  return warnings;
}

}  // namespace

Expected<PrintedValue> ReadPrintedValue(const std::string& text, double whole) {
  const bool percent = whole != 0 && !text.empty() && text.back() == '%';
  const std::string number = percent ? text.substr(0, text.size() - 1) : text;
  const std::optional<double> value = ParseNumber(number);
  if (!value || !std::isfinite(*value)) {
    return Fail(fmt::format("expected a number{}, found '{}'{}",
                            whole != 0 ? " per kelvin, or in percent such as 0.05%" : "", text,
                            DecimalPointHint(number)));
  }
  const double unit = percent ? whole / 100 : 1;
  return PrintedValue{*value * unit, HalfUnit(number) * std::fabs(unit)};
}

std::vector<double> SharedOf(const DataSheetFit& fit, const DataSheetMember& member) {
  const Translation& at = fit.translation;
  return SharedOf(at, DeviceOf(member), fit.shared[at.alpha_sc],
                  {fit.shared[at.bandgap], fit.shared[at.bandgap_slope]});
}

Expected<DataSheetFit> FitDataSheet(const DataSheet& sheet, ConstantSet constants) {
  TRY(CheckDataSheet(sheet));
  TRY(CheckSheetOfMaterial(sheet));
  TranslationSpec spec;
  spec.cells_in_series = sheet.cells_in_series;
  spec.constants = constants;
  TRY(Translation translation, MakeTranslation(spec));
  const auto solution =
      SolveKeyPoints(sheet.values, sheet.cells_in_series, GapOf(sheet), constants);
  if (!solution) {
    const auto family = FindDataSheetFamily(sheet, constants);
    return family ? Fail(fmt::format("no single diode in {} cells has a curve through these points",
                                     sheet.cells_in_series))
                  : tl::unexpected<Error>(family.error());
  }
  DataSheetFit fit;
  fit.translation = std::move(translation);
  fit.shared = SharedOf(fit.translation, solution->device, sheet.values.alpha_sc_A_K, GapOf(sheet));
  fit.checks = ChecksOf(sheet, fit);
  for (int k = 0; k < kSolvedValues; ++k) {
    const double error = std::fabs(fit.checks[k].given / fit.checks[k].asked - 1);
    fit.largest_relative_error = std::max(fit.largest_relative_error, error);
  }
  const double n = solution->device.n;
  fit.usual = IsOfAJunction(n / JunctionsOfSheet(sheet));
  RoundedFits rounded = FitRounded(sheet, constants, fit);
  for (auto warnings :
       {WarnOfTheSolution(sheet, *solution, fit.checks[kSolvedValues - 1]), WarnOfTheGap(sheet),
        WarnOfTheDevice(sheet, fit), WarnOfTheRounding(rounded)}) {
    Append(std::move(warnings), &fit.warnings);
  }
  fit.ranges = std::move(rounded.ranges);
  const double low = fit.ranges.empty() ? n : fit.ranges[kRangeOfIdeality].low;
  const double high = fit.ranges.empty() ? n : fit.ranges[kRangeOfIdeality].high;
  TRY(fit.family, FamilyOfSheet(sheet, constants, solution->device, low, high));
  return fit;
}

}  // namespace lyrefit
