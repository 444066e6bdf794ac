#include "lyrefit/family/key_point_curve.h"

#include <cmath>

#include "lyrefit/base/roots.h"

namespace lyrefit {
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
