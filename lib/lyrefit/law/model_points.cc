#include "lyrefit/law/model_points.h"

#include <cmath>

#include "lyrefit/base/numbers.h"
#include "lyrefit/law/current.h"
#include "lyrefit/law/extension.h"

namespace lyrefit {
namespace {

// Root of a falling function between a (positive) and b (negative).
template <class F>
double Bisect(const F& f, double a, double b) {
  for (int k = 0; k < 200 && b - a > 1e-15 * std::fabs(b); ++k) {
    const double middle = 0.5 * (a + b);
    (f(middle) > 0 ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

// Of a fine sweep from short circuit to a little beyond open circuit.
KeyPoints ExtendedKeyPoints(const Device& device, const double* p) {
  constexpr int kPoints = 2000;
  Device base = device;
  base.extension = nullptr;
  const double voc = ModelKeyPoints(base, p).open_circuit_voltage_V;
  if (!(voc > 0)) return FindKeyPoints({}, {});
  std::vector<double> voltage_V;
  for (int k = 0; k <= kPoints; ++k) voltage_V.push_back(1.05 * voc * k / kPoints);
  return FindKeyPoints(voltage_V, ExtendedCurrents(device, p, voltage_V));
}

}  // namespace

KeyPoints ModelKeyPoints(const Device& device, const double* p) {
  if (device.extension != nullptr) return ExtendedKeyPoints(device, p);
  KeyPoints points{kUnknown, kUnknown, kUnknown, kUnknown, kUnknown, kUnknown};
  points.short_circuit_current_A = SolveOperatingPoint(device, p, 0).current_A;
  // In the dark the root at V = 0 is zero but for rounding.
  if (!(points.short_circuit_current_A > 1e-15 * p[kIph]) || !(p[kIph] > 0)) return points;
  // At open circuit no current flows through Rs: the junction sees V itself.
  const auto junction = [&](double v) { return JunctionCurrent(device, p, v); };
  double above = device.module_thermal_voltage_V;
  for (int k = 0; k < 60 && junction(above) > 0; ++k) above *= 2;
  if (junction(above) > 0) return points;
  const double voc = Bisect(junction, 0, above);
  // dP/dV = I + V dI/dV with dI/dV = F' / (1 - Rs F') falls through zero once.
  const auto power_slope = [&](double v) {
    const OperatingPoint point = SolveOperatingPoint(device, p, v);
    return point.current_A + v * point.conductance_S * ImplicitFactor(device, p, point);
  };
  points.open_circuit_voltage_V = voc;
  points.max_power_voltage_V = Bisect(power_slope, 0, voc);
  points.max_power_current_A = SolveOperatingPoint(device, p, points.max_power_voltage_V).current_A;
  points.max_power_W = points.max_power_voltage_V * points.max_power_current_A;
  points.fill_factor = points.max_power_W / (points.short_circuit_current_A * voc);
  return points;
}

}  // namespace lyrefit
