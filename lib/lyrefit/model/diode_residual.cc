#include "lyrefit/model/diode_residual.h"

#include <glog/logging.h>

#include "lyrefit/model/model_points.h"

namespace lyrefit {

DiodeResidual::DiodeResidual(const Device& device, Objective objective, double voltage_V,
                             double current_A, double weight)
    : size_(device.size()),
      objective_(objective),
      voltage_V_(voltage_V),
      current_A_(current_A),
      weight_(weight) {
  CHECK(device.effects == nullptr) << "a residual of one reading cannot have effects";
  CHECK_LE(size_, kMostParameters);
  device_.terms = device.terms;
  device_.resistance_series = device.resistance_series;
  device_.module_thermal_voltage_V = device.module_thermal_voltage_V;
}

DiodeResidual::Root DiodeResidual::Solve(const double* p) const {
  const OperatingPoint point = SolveOperatingPoint(device_, p, voltage_V_);
  return {point.current_A, point.junction_voltage_V, ImplicitFactor(device_, p, point)};
}

}  // namespace lyrefit
