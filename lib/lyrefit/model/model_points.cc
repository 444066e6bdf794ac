#include "lyrefit/model/model_points.h"

#include <cmath>

#include "lyrefit/base/dual.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/roots.h"
#include "lyrefit/model/current.h"
#include "lyrefit/model/device_effects.h"

namespace lyrefit {
namespace {

// Key points of a device with effects, from a fine sweep from short circuit to 5 % beyond the
// base's Voc.
KeyPoints ExtendedKeyPoints(const Device& device, const double* p) {
  constexpr int kPoints = 2000;
  Device base = device;
  base.effects = nullptr;
  const double voc = ModelOpenCircuit(base, p);
  if (!(voc > 0)) return FindKeyPoints({}, {});
  std::vector<double> voltage_V;
  for (int k = 0; k <= kPoints; ++k) voltage_V.push_back(1.05 * voc * k / kPoints);
  return FindKeyPoints(voltage_V, ExtendedCurrents(device, p, voltage_V));
}

}  // namespace

double ModelOpenCircuit(const Device& device, const double* p) {
  if (device.effects != nullptr) return ExtendedKeyPoints(device, p).open_circuit_voltage_V;
  // At open circuit no current flows through Rs: the junction voltage is V.
  const auto junction = [&](double v) { return JunctionCurrent(device, p, v); };
  if (!(p[kIph] > 0)) return kUnknown;
  double above = device.module_thermal_voltage_V;
  for (int k = 0; k < 60 && junction(above) > 0; ++k) above *= 2;
  return junction(above) > 0 ? kUnknown : RootBetween(junction, 0, above);
}

KeyPoints ModelKeyPoints(const Device& device, const double* p) {
  if (device.effects != nullptr) return ExtendedKeyPoints(device, p);
  KeyPoints points{kUnknown, kUnknown, kUnknown, kUnknown, kUnknown, kUnknown};
  points.short_circuit_current_A = SolveOperatingPoint(device, p, 0).current_A;
  // In the dark the current at V = 0 is zero except for rounding.
  if (!(points.short_circuit_current_A > 1e-15 * p[kIph])) return points;
  const double voc = ModelOpenCircuit(device, p);
  if (std::isnan(voc)) return points;
  // As functions of the junction voltage Vj, I = F(Vj) and V = Vj - I Rs are explicit. At the
  // maximum power point dP/dVj = I + (Vj - 2 I Rs) F'(Vj) is 0; it has the sign of dP/dV.
  const double rs = p[device.resistance_series];
  const auto power_slope = [&](double v) {
    const Dual<1> current = JunctionCurrent(device, p, Dual<1>(v, 0));
    return current.a + (v - 2 * current.a * rs) * current.v[0];
  };
  // Junction voltage at short circuit.
  const double lowest = points.short_circuit_current_A * rs;
  const double junction_V = RootBetween(power_slope, lowest, voc);
  points.open_circuit_voltage_V = voc;
  points.max_power_current_A = JunctionCurrent(device, p, junction_V);
  points.max_power_voltage_V = junction_V - points.max_power_current_A * rs;
  points.max_power_W = points.max_power_voltage_V * points.max_power_current_A;
  points.fill_factor = points.max_power_W / (points.short_circuit_current_A * voc);
  return points;
}

}  // namespace lyrefit
