#include "lyrefit/family/key_point_solver.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/law/translation.h"

namespace lyrefit {
namespace {

// Range of n, as exponents Voc / (n Ns Vt) that no device leaves. n = 1 has about 25.
constexpr double kLargestExponentAtVoc = 600;
constexpr double kSmallestExponentAtVoc = 2;
constexpr int kIdealities = 120;
constexpr int kResistances = 32;
constexpr double kUsualIdeality = 1.2;
constexpr double kNothing = 1e-9;  // V over Rs, or 1/V through the shunt, at the border

// A place where f changes its sign between a and b, to the last bit.
template <class F>
double SignChange(const F& f, double a, double b) {
  const bool positive = f(a) > 0;
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (a + b);
    if (middle == a || middle == b) break;
    ((f(middle) > 0) == positive ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

// The curve through the three points for given n and Rs. `diode_A` is Is exp(Voc / (n Ns Vt)): Is
// itself may be too small for a double.
struct Curve {
  double n;
  double rs;
  double photocurrent;
  double diode_A;
  double conductance;
  double slope_error;  // of dP/dV = 0 at the maximum power point, in A
};

// What a data sheet says, and of how many cells at which temperature.
struct KeyPointSheet {
  const DataSheetValues& values;
  double thermal_V;  // of the module
  ConstantSet constants;
};

// Points on the curve: Isc, Voc, (Vmp, Imp). The exponentials are relative to that at Voc.
Curve Through(const KeyPointSheet& sheet, double n, double rs) {
  const double a = n * sheet.thermal_V;
  const double isc = sheet.values.short_circuit_current_A;
  const double imp = sheet.values.max_power_current_A;
  const double voc = sheet.values.open_circuit_voltage_V;
  const double short_V = isc * rs;
  const double power_V = sheet.values.max_power_voltage_V + imp * rs;
  const double at_short = std::exp((short_V - voc) / a);
  const double at_power = std::exp((power_V - voc) / a);
  // Differences to the short circuit rid the equations of Iph.
  const double open_e = 1 - at_short, open_v = voc - short_V;
  const double power_e = at_power - at_short, power_v = power_V - short_V;
  const double determinant = open_e * power_v - power_e * open_v;
  Curve c{n, rs, 0, 0, 0, 0};
  c.diode_A = (isc * power_v - (isc - imp) * open_v) / determinant;
  c.conductance = (open_e * (isc - imp) - power_e * isc) / determinant;
  c.photocurrent = c.diode_A * (1 - std::exp(-voc / a)) + c.conductance * voc;
  const double steepness = c.diode_A * at_power / a + c.conductance;
  c.slope_error = steepness * (sheet.values.max_power_voltage_V - rs * imp) - imp;
  return c;
}

// The curve for n whose power is largest where it should be; nothing if that takes a negative
// Rs, 1/Rsh or Is.
std::optional<Curve> Physical(const KeyPointSheet& sheet, double n) {
  const auto conductance = [&](double rs) { return Through(sheet, n, rs).conductance; };
  if (!(conductance(0) >= 0)) return std::nullopt;
  // Up to this Rs the voltages at the junction keep their order; the shunt is perfect before.
  double largest = (sheet.values.open_circuit_voltage_V - sheet.values.max_power_voltage_V) /
                   sheet.values.max_power_current_A;
  largest = std::min(largest, sheet.values.max_power_voltage_V / sheet.values.max_power_current_A);
  if (!(conductance(largest) >= 0)) largest = SignChange(conductance, 0, largest);
  const auto slope_error = [&](double rs) { return Through(sheet, n, rs).slope_error; };
  const bool positive = slope_error(0) > 0;
  for (int k = 1; k <= kResistances; ++k) {
    const double rs = largest * k / kResistances;
    if ((slope_error(rs) > 0) == positive) continue;
    const Curve curve =
        Through(sheet, n, SignChange(slope_error, largest * (k - 1) / kResistances, rs));
    if (curve.diode_A > 0) return curve;
  }
  return std::nullopt;
}

// The current at Voc + 2 K beta_oc and 27 C, which should be 0.
double WarmError(const KeyPointSheet& sheet, const Curve& c) {
  const double k_eV = ThermalVoltage(1.0, sheet.constants);
  const double warm_K = kReferenceTemperature_K + kVocStep_K;
  const double ratio = warm_K / kReferenceTemperature_K;
  const double gap = kSiliconBandGap_eV * (1 + kSiliconBandGapSlope_1_K * kVocStep_K);
  const double growth = 3 * std::log(ratio) +
                        kSiliconBandGap_eV / (k_eV * kReferenceTemperature_K) -
                        gap / (k_eV * warm_K);
  const double a = c.n * sheet.thermal_V;
  const double voc = sheet.values.open_circuit_voltage_V;
  const double warm_V = voc + kVocStep_K * sheet.values.beta_oc_V_K;
  const double diode =
      c.diode_A * (std::exp(growth + warm_V / (a * ratio) - voc / a) - std::exp(growth - voc / a));
  return c.photocurrent + sheet.values.alpha_sc_A_K * kVocStep_K - diode - c.conductance * warm_V;
}

ReferenceDevice ToDevice(const KeyPointSheet& sheet, const Curve& c) {
  const double is =
      c.diode_A * std::exp(-sheet.values.open_circuit_voltage_V / (c.n * sheet.thermal_V));
  return {c.photocurrent, is, c.n, c.rs, c.conductance};
}

// Physical curves by rising n: a fine grid, and the last n on either side of every gap.
std::vector<Curve> PhysicalCurves(const KeyPointSheet& sheet, double lowest, double highest) {
  const auto border = [&](double inside, double outside) {
    for (int k = 0; k < 100; ++k) {
      const double middle = 0.5 * (inside + outside);
      if (middle == inside || middle == outside) break;
      (Physical(sheet, middle) ? inside : outside) = middle;
    }
    return *Physical(sheet, inside);
  };
  std::vector<Curve> curves;
  double before = 0;
  bool inside = false;
  for (int k = 0; k <= kIdealities; ++k) {
    const double n = lowest * std::pow(highest / lowest, static_cast<double>(k) / kIdealities);
    const std::optional<Curve> curve = Physical(sheet, n);
    if (curve && !inside && k > 0) curves.push_back(border(n, before));
    if (!curve && inside) curves.push_back(border(before, n));
    if (curve) curves.push_back(*curve);
    inside = curve.has_value();
    before = n;
  }
  return curves;
}

// The physical curve that misses beta_oc the least, with what ends there set to exactly nothing.
KeyPointSolution Nearest(const KeyPointSheet& sheet, const std::vector<Curve>& curves) {
  const Curve* best = &curves.front();
  for (const Curve& curve : curves) {
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

std::optional<KeyPointSolution> SolveKeyPoints(const DataSheetValues& values, int cells_in_series,
                                               ConstantSet constants) {
  const double thermal_V = cells_in_series * ThermalVoltage(kReferenceTemperature_K, constants);
  const double voc_in_thermal = values.open_circuit_voltage_V / thermal_V;
  const KeyPointSheet sheet{values, thermal_V, constants};
  const std::vector<Curve> curves = PhysicalCurves(sheet, voc_in_thermal / kLargestExponentAtVoc,
                                                   voc_in_thermal / kSmallestExponentAtVoc);
  if (curves.empty()) return std::nullopt;
  const auto warm_error = [&](double n) {
    const std::optional<Curve> curve = Physical(sheet, n);
    return curve ? WarmError(sheet, *curve) : kUnknown;
  };
  std::vector<Curve> found;
  for (std::size_t k = 0; k + 1 < curves.size(); ++k) {
    const double left = WarmError(sheet, curves[k]);
    const double right = WarmError(sheet, curves[k + 1]);
    if ((left > 0) == (right > 0)) continue;
    const auto curve = Physical(sheet, SignChange(warm_error, curves[k].n, curves[k + 1].n));
    // Across a gap between physical curves the sign may change without a root.
    if (curve && std::fabs(WarmError(sheet, *curve)) < 1e-9 * curve->photocurrent) {
      found.push_back(*curve);
    }
  }
  if (found.empty()) return Nearest(sheet, curves);
  const Curve* best = &found.front();
  for (const Curve& curve : found) {
    if (std::fabs(curve.n - kUsualIdeality) < std::fabs(best->n - kUsualIdeality)) best = &curve;
  }
  return KeyPointSolution{ToDevice(sheet, *best), Border::kNone, static_cast<int>(found.size())};
}

}  // namespace lyrefit
