#include "lyrefit/family/key_point_solver.h"

#include <cmath>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/roots.h"
#include "lyrefit/curve/technology.h"

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

namespace {

constexpr int kResistances = 32;

}  // namespace

// Two linear equations in Is and 1 / Rsh. All exponentials are relative to that at Voc.
KeyPointCurve CurveThrough(const KeyPointSheet& sheet, double n, double rs) {
  const double a = n * sheet.thermal_V;
  const double isc = sheet.values.short_circuit_current_A;
  const double imp = sheet.values.max_power_current_A;
  const double voc = sheet.values.open_circuit_voltage_V;
  const double short_V = isc * rs;
  const double power_V = sheet.values.max_power_voltage_V + imp * rs;
  const double at_short = std::exp((short_V - voc) / a);
  const double at_power = std::exp((power_V - voc) / a);
  // Differences to the short circuit eliminate Iph from the equations.
  const double open_e = 1 - at_short, open_v = voc - short_V;
  const double power_e = at_power - at_short, power_v = power_V - short_V;
  const double determinant = open_e * power_v - power_e * open_v;
  KeyPointCurve c{n, rs, 0, 0, 0, 0};
  c.diode_A = (isc * power_v - (isc - imp) * open_v) / determinant;
  c.conductance = (open_e * (isc - imp) - power_e * isc) / determinant;
  c.photocurrent = c.diode_A * (1 - std::exp(-voc / a)) + c.conductance * voc;
  const double steepness = c.diode_A * at_power / a + c.conductance;
  c.slope_error = steepness * (sheet.values.max_power_voltage_V - rs * imp) - imp;
  return c;
}

double LargestResistance(const KeyPointSheet& sheet) {
  const DataSheetValues& v = sheet.values;
  return (v.open_circuit_voltage_V - v.max_power_voltage_V) / v.max_power_current_A;
}

std::optional<KeyPointCurve> PhysicalCurve(const KeyPointSheet& sheet, double n) {
  const auto conductance = [&](double rs) { return CurveThrough(sheet, n, rs).conductance; };
  if (!(conductance(0) >= 0)) return std::nullopt;
  // 1/Rsh falls to 0 at some Rs below the largest one, and tends to minus infinity at the largest.
  const double largest = SignChange(conductance, 0, LargestResistance(sheet));
  const auto slope_error = [&](double rs) { return CurveThrough(sheet, n, rs).slope_error; };
  const bool positive = slope_error(0) > 0;
  for (int k = 1; k <= kResistances; ++k) {
    const double rs = largest * k / kResistances;
    if ((slope_error(rs) > 0) == positive) continue;
    const KeyPointCurve curve =
        CurveThrough(sheet, n, SignChange(slope_error, largest * (k - 1) / kResistances, rs));
    if (curve.diode_A > 0) return curve;
  }
  return std::nullopt;
}

ReferenceDevice ToDevice(const KeyPointSheet& sheet, const KeyPointCurve& c) {
  const double is =
      c.diode_A * std::exp(-sheet.values.open_circuit_voltage_V / (c.n * sheet.thermal_V));
  return {c.photocurrent, is, c.n, c.rs, c.conductance};
}

std::vector<double> SharedOf(const Translation& at, const ReferenceDevice& device, double alpha,
                             const BandGap& gap) {
  std::vector<double> shared(at.size());
  shared[at.photocurrent] = device.photocurrent_A;
  shared[at.saturation_current] = device.saturation_current_A;
  shared[at.n] = device.n;
  shared[at.resistance_series] = device.resistance_series_ohm;
  shared[at.resistance_shunt] = 1 / device.shunt_conductance_S;  // infinite without a shunt
  shared[at.alpha_sc] = alpha;
  shared[at.bandgap] = gap.eV;
  shared[at.bandgap_slope] = gap.slope_1_K;
  return shared;
}

}  // namespace lyrefit
