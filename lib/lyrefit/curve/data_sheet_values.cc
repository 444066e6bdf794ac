#include "lyrefit/curve/data_sheet_values.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "lyrefit/base/try.h"
#include "lyrefit/curve/technology.h"

namespace lyrefit {
namespace {

constexpr double kLowestFillFactor = 0.3;
constexpr double kHighestFillFactor = 0.9;
constexpr double kLargestRelativeAlpha_1_K = 0.005;
constexpr double kLargestRelativeBeta_1_K = 0.01;

Expected<void> CheckAlpha(const DataSheetValues& v) {
  if (v.beta_oc_V_K > 0 && v.alpha_sc_A_K < 0) {
    return Fail(fmt::format(
        "expected an alpha_sc around 0.05 % of Isc and a negative beta_oc in V/K, found {:.4g} and "
        "{:.4g}: were alpha and beta exchanged?",
        v.alpha_sc_A_K, v.beta_oc_V_K));
  }
  if (std::fabs(v.alpha_sc_A_K) > kLargestRelativeAlpha_1_K * v.short_circuit_current_A) {
    return Fail(
        fmt::format("expected alpha_sc in A/K, found {} beside an Isc of {} A: is it in percent?",
                    v.alpha_sc_A_K, v.short_circuit_current_A));
  }
  return {};
}

Expected<void> CheckBeta(const DataSheetValues& v) {
  const double relative = v.beta_oc_V_K / v.open_circuit_voltage_V;
  if (!(relative < 0) || relative < -kLargestRelativeBeta_1_K) {
    return Fail(fmt::format(
        "expected a negative beta_oc in V/K, found {} beside a Voc of {} V: is it in percent?",
        v.beta_oc_V_K, v.open_circuit_voltage_V));
  }
  return {};
}

// "66 or 72": usual numbers of cells that bring Voc to what a silicon cell has.
std::string LikelyNumbers(double voc_V) {
  constexpr double kLeast_V = 0.58, kMost_V = 0.75;
  std::string numbers;
  for (const int cells : {36, 48, 54, 60, 66, 72, 78, 96, 108, 120, 132, 144}) {
    if (!(voc_V / cells > kLeast_V && voc_V / cells < kMost_V)) continue;
    numbers += (numbers.empty() ? "" : " or ") + std::to_string(cells);
  }
  return numbers;
}

Expected<void> CheckCurrentOfCell(const DataSheet& sheet) {
  // The largest wafers, of 441 cm2, give 20 A and 12 W.
  constexpr double kMost_A = 30, kMostOfCell_W = 15;
  const DataSheetValues& v = sheet.values;
  const double cell_W = v.max_power_current_A * v.max_power_voltage_V / sheet.cells_in_series;
  if (v.short_circuit_current_A <= kMost_A && cell_W <= kMostOfCell_W) return {};
  return Fail(fmt::format(
      "Isc of {:g} A and {:.3g} W a cell are more than any cell gives (20 A, 12 W): milliampere? "
      "write --isc {:g} --imp {:g} then; or is the number of cells ({}) another?",
      v.short_circuit_current_A, cell_W, v.short_circuit_current_A / 1000,
      v.max_power_current_A / 1000, sheet.cells_in_series));
}

Expected<void> CheckNumber(const DataSheet& sheet, const DataSheetRow& row) {
  if (std::isfinite(sheet.values.*row.value)) return {};
  return Fail(fmt::format("no number for {}", row.name));
}

}  // namespace

Expected<void> CheckDataSheetPoints(const DataSheetValues& v) {
  const double isc = v.short_circuit_current_A, imp = v.max_power_current_A;
  const double voc = v.open_circuit_voltage_V, vmp = v.max_power_voltage_V;
  if (!(isc > imp && imp > 0)) {
    return Fail(fmt::format("expected Isc > Imp > 0, found Isc = {} A and Imp = {} A", isc, imp));
  }
  if (!(voc > vmp && vmp > 0)) {
    return Fail(fmt::format("expected Voc > Vmp > 0, found Voc = {} V and Vmp = {} V", voc, vmp));
  }
  const double fill_factor = imp * vmp / (isc * voc);
  if (!(fill_factor > kLowestFillFactor && fill_factor < kHighestFillFactor)) {
    return Fail(fmt::format("expected a fill factor between {} and {}, found {:.4g}",
                            kLowestFillFactor, kHighestFillFactor, fill_factor));
  }
  // A concave curve lies below its tangent at the maximum power point, which meets the axes at 2
  // Imp and 2 Vmp.
  if (!(2 * imp > isc && 2 * vmp > voc)) {
    return Fail("no falling, concave curve has its maximum power below half of Isc or Voc");
  }
  return {};
}

Expected<void> CheckDataSheetForFamily(const DataSheet& sheet) {
  for (const DataSheetRow& row : kDataSheetRows) {
    if (row.value != &DataSheetValues::beta_oc_V_K) TRY(CheckNumber(sheet, row));
  }
  if (sheet.cells_in_series < 1) {
    return Fail(fmt::format("expected at least 1 cell in series, found {}", sheet.cells_in_series));
  }
  TRY(CheckDataSheetPoints(sheet.values));
  return CheckAlpha(sheet.values);
}

int JunctionsOfSheet(const DataSheet& sheet) {
  const Technology* const known = FindTechnology(sheet.technology);
  if (known == nullptr) return 1;
  const double cell_V = sheet.values.open_circuit_voltage_V / sheet.cells_in_series;
  return cell_V > known->most_Voc_V / known->junctions ? known->junctions : 1;
}

Expected<void> CheckSheetOfMaterial(const DataSheet& sheet) {
  const Technology* const known = FindTechnology(sheet.technology);
  const Technology& of = known != nullptr ? *known : Silicon();
  const double voc = sheet.values.open_circuit_voltage_V, cell_V = voc / sheet.cells_in_series;
  const double most_V = sheet.EgRef_eV ? *sheet.EgRef_eV * of.junctions : of.most_Voc_V;
  if (cell_V <= most_V) return CheckCurrentOfCell(sheet);
  const std::string found = fmt::format("Voc of {:g} V is {:.3g} V for each of {} cells", voc,
                                        cell_V, sheet.cells_in_series);
  if (sheet.EgRef_eV) {
    return Fail(
        fmt::format("{}, more than the stated band gap of {:g} eV allows: is the number of "
                    "cells (--cells) right?",
                    found, *sheet.EgRef_eV));
  }
  const std::string likely = LikelyNumbers(voc);
  const std::string cells =
      "--cells" + (likely.empty() || !of.silicon ? "" : " " + likely + " of silicon?");
  return Fail(fmt::format(
      "{}, more than {} gives at one sun ({:.2f} V){}: state the number of cells ({}), the "
      "technology (--technology CdTe, GaAs, perovskite, ...) or its band gap (--EgRef)",
      found, known != nullptr ? known->name : "silicon", of.most_Voc_V,
      known != nullptr ? "" : ", and no technology is stated", cells));
}

Expected<void> CheckDataSheet(const DataSheet& sheet) {
  for (const DataSheetRow& row : kDataSheetRows) {
    TRY(CheckNumber(sheet, row));
    const double half = sheet.half_unit.*row.value;
    if (!(half >= 0) || !std::isfinite(half)) {
      return Fail(fmt::format("expected a rounding of {} of at least 0 {}, found {}", row.name,
                              row.unit, half));
    }
  }
  TRY(CheckDataSheetForFamily(sheet));
  return CheckBeta(sheet.values);
}

}  // namespace lyrefit
