#include "lyrefit/family/key_point_solver.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/roots.h"
#include "lyrefit/curve/technology.h"
#include "lyrefit/family/key_point_curve.h"
#include "lyrefit/model/translation.h"

namespace lyrefit {
namespace {

// Range of n, as exponents Voc / (n Ns Vt) that no device exceeds. n = 1 has about 25.
constexpr double kLargestExponentAtVoc = 600;
constexpr double kSmallestExponentAtVoc = 2;
constexpr int kIdealities = 120;
constexpr double kUsualIdeality = 1.2;
constexpr double kNothing = 1e-9;  // V across Rs, or 1/V through the shunt: counts as 0

// Residual current at Voc + 2 K beta_oc and 27 C, which is 0 for an exact solution. As in
// CurveThrough exponentials are relative to that at Voc, since Is may underflow a double: no Device
// can hold it.
double WarmError(const KeyPointSheet& sheet, const KeyPointCurve& c) {
  const double k_eV = ThermalVoltage(1.0, sheet.constants);
  const double warm_K = kReferenceTemperature_K + kVocStep_K;
  const double ratio = warm_K / kReferenceTemperature_K;
  const double gap = sheet.gap.eV * (1 + sheet.gap.slope_1_K * kVocStep_K);
  const double growth =
      3 * std::log(ratio) + sheet.gap.eV / (k_eV * kReferenceTemperature_K) - gap / (k_eV * warm_K);
  const double a = c.n * sheet.thermal_V;
  const double voc = sheet.values.open_circuit_voltage_V;
  const double warm_V = voc + kVocStep_K * sheet.values.beta_oc_V_K;
  const double diode =
      c.diode_A * (std::exp(growth + warm_V / (a * ratio) - voc / a) - std::exp(growth - voc / a));
  return c.photocurrent + sheet.values.alpha_sc_A_K * kVocStep_K - diode - c.conductance * warm_V;
}

// Physical curves by rising n: those on a fine grid, and the outermost n on either side of every
// gap.
std::vector<KeyPointCurve> PhysicalCurves(const KeyPointSheet& sheet, double lowest,
                                          double highest) {
  const auto border = [&](double inside, double outside) {
    const auto physical = [&](double n) { return PhysicalCurve(sheet, n).has_value(); };
    return *PhysicalCurve(sheet, LastWhere(physical, inside, outside));
  };
  std::vector<KeyPointCurve> curves;
  double before = 0;
  bool inside = false;
  for (int k = 0; k <= kIdealities; ++k) {
    const double n = lowest * std::pow(highest / lowest, static_cast<double>(k) / kIdealities);
    const std::optional<KeyPointCurve> curve = PhysicalCurve(sheet, n);
    if (curve && !inside && k > 0) curves.push_back(border(n, before));
    if (!curve && inside) curves.push_back(border(before, n));
    if (curve) curves.push_back(*curve);
    inside = curve.has_value();
    before = n;
  }
  return curves;
}

// The physical curve with the smallest error of beta_oc. The quantity that bounds it is set to
// exactly 0.
KeyPointSolution Nearest(const KeyPointSheet& sheet, const std::vector<KeyPointCurve>& curves) {
  const KeyPointCurve* best = &curves.front();
  for (const KeyPointCurve& curve : curves) {
    if (std::fabs(WarmError(sheet, curve)) < std::fabs(WarmError(sheet, *best))) {
      best = &curve;
    }
  }
  KeyPointSolution solution{ToDevice(sheet, *best), Border::kIdeality, 0};
  if (best->rs * best->photocurrent < kNothing) {
    solution.border = Border::kNoSeriesResistance;
    solution.device.resistance_series_ohm = 0;
  } else if (best->conductance / best->photocurrent < kNothing) {
    solution.border = Border::kPerfectShunt;
    solution.device.shunt_conductance_S = 0;
  }
  return solution;
}

}  // namespace

BandGap GapOf(const DataSheet& sheet) {
  const Technology* const known = FindTechnology(sheet.technology);
  const Technology& of = known != nullptr ? *known : Silicon();
  // A stated gap has the slope of silicon's unless its technology or its own is stated.
  return {sheet.EgRef_eV.value_or(of.bandgap_eV), sheet.dEgdT_1_K.value_or(of.bandgap_slope_per_K)};
}

std::optional<KeyPointSolution> SolveKeyPoints(const DataSheetValues& values, int cells_in_series,
                                               const BandGap& gap, ConstantSet constants) {
  const double thermal_V = cells_in_series * ThermalVoltage(kReferenceTemperature_K, constants);
  const double voc_in_thermal = values.open_circuit_voltage_V / thermal_V;
  const KeyPointSheet sheet{values, thermal_V, constants, gap};
  const std::vector<KeyPointCurve> curves = PhysicalCurves(
      sheet, voc_in_thermal / kLargestExponentAtVoc, voc_in_thermal / kSmallestExponentAtVoc);
  if (curves.empty()) return std::nullopt;
  const auto warm_error = [&](double n) {
    const std::optional<KeyPointCurve> curve = PhysicalCurve(sheet, n);
    return curve ? WarmError(sheet, *curve) : kUnknown;
  };
  std::vector<KeyPointCurve> found;
  for (std::size_t k = 0; k + 1 < curves.size(); ++k) {
    const double left = WarmError(sheet, curves[k]);
    const double right = WarmError(sheet, curves[k + 1]);
    if ((left > 0) == (right > 0)) continue;
    const auto curve = PhysicalCurve(sheet, SignChange(warm_error, curves[k].n, curves[k + 1].n));
    // The sign may change across a gap between physical curves without a root.
    if (curve && std::fabs(WarmError(sheet, *curve)) < 1e-9 * curve->photocurrent) {
      found.push_back(*curve);
    }
  }
  if (found.empty()) return Nearest(sheet, curves);
  const KeyPointCurve* best = &found.front();
  for (const KeyPointCurve& curve : found) {
    if (std::fabs(curve.n - kUsualIdeality) < std::fabs(best->n - kUsualIdeality)) best = &curve;
  }
  return KeyPointSolution{ToDevice(sheet, *best), Border::kNone, static_cast<int>(found.size())};
}

}  // namespace lyrefit
