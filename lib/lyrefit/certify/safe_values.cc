#include "lyrefit/certify/safe_values.h"

#include <glog/logging.h>

namespace lyrefit {
namespace {

// k / q in volt per kelvin as a quotient of whole numbers.
WideInterval BoltzmannOverCharge(ConstantSet constants) {
  const auto quotient = [](double above, double below) {
    return WideInterval(above) / WideInterval(below);
  };
  switch (constants) {
    case ConstantSet::kCodata:
      return quotient(1380649, 16021766340);
    case ConstantSet::kLiterature:
      return quotient(13806503, 160217646000);
    case ConstantSet::kPaper:
      return quotient(138065, 1602170000);
  }
  LOG(FATAL) << "unknown set of constants";
}

}  // namespace

WideInterval SafeThermalVoltage(const Conditions& conditions, ConstantSet constants) {
  return WideInterval(conditions.cells_in_series) * WideInterval(conditions.cell_temperature_K) *
         BoltzmannOverCharge(constants);
}

Window SafeWindow(double n_lower, double n_upper, const WideInterval& thermal_voltage_V) {
  const WideInterval one(1);
  return {Lower(Hull(one / (WideInterval(n_upper) * thermal_voltage_V))),
          Upper(Hull(one / (WideInterval(n_lower) * thermal_voltage_V)))};
}

double SafeRmse(double half_sum_of_squares, std::size_t points) {
  const Interval mean = 2.0 * Interval(half_sum_of_squares) / static_cast<double>(points);
  return std::max(0.0, Lower(sqrt(mean)));
}

double SafeGap(double rmse, double lower) {
  return rmse > 0 ? std::max(0.0, Upper(1.0 - Interval(lower) / rmse)) : 0;
}

double SafeUpperRmse(const IvCurve& curve, const WideInterval& thermal_voltage_V,
                     double photocurrent_A, double resistance_series_ohm,
                     const WideInterval& conductance_shunt_S,
                     const std::vector<SafeDiode>& diodes) {
  WideInterval sum(0);
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const WideInterval current(curve.current_A[k]);
    const WideInterval vd =
        WideInterval(curve.voltage_V[k]) + WideInterval(resistance_series_ohm) * current;
    WideInterval residual = WideInterval(photocurrent_A) - conductance_shunt_S * vd - current;
    for (const SafeDiode& diode : diodes) {
      const WideInterval exponent = vd / (WideInterval(diode.n) * thermal_voltage_V);
      residual -= WideInterval(diode.saturation_current_A) * (exp(exponent) - WideInterval(1));
    }
    sum += square(residual);
  }
  return Upper(Hull(sqrt(sum / WideInterval(static_cast<double>(curve.size())))));
}

}  // namespace lyrefit
