#include "lyrefit/model/diode_residual.h"

#include <glog/logging.h>

#include "lyrefit/model/current.h"

namespace lyrefit {

SolvedPoint SolvePoint(const Device& device, const double* p, double voltage_V) {
  const OperatingPoint point = SolveOperatingPoint(device, p, voltage_V);
  return {point.current_A, ExplicitCurrent(device, p, voltage_V, point.current_A),
          1 / ImplicitFactor(device, p, point)};
}

DiodeResidual::DiodeResidual(const Device& device, Objective objective, double voltage_V,
                             double current_A, double weight)
    : size_(device.size()),
      objective_(objective),
      voltage_V_(voltage_V),
      current_A_(current_A),
      weight_(weight) {
  CHECK(device.effects == nullptr) << "effects need a whole measurement";
  CHECK_LE(size_, kMost);
  device_.terms = device.terms;
  device_.resistance_series = device.resistance_series;
  device_.module_thermal_voltage_V = device.module_thermal_voltage_V;
}

}  // namespace lyrefit
