#include "lyrefit/curve/data_sheet_values.h"

#include <fmt/format.h>

#include <cmath>
#include "lyrefit/base/try.h"

namespace lyrefit {
namespace {

constexpr double kLowestFillFactor = 0.3;
constexpr double kHighestFillFactor = 0.9;
constexpr double kLargestRelativeAlpha_1_K = 0.005;
constexpr double kLargestRelativeBeta_1_K = 0.01;

Expected<void> CheckAlpha(const DataSheetValues& v) {
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
