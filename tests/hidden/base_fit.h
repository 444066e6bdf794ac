#pragma once

#include <array>
#include <vector>

#include "hidden/plan.h"

namespace hidden {

// One diode for all readings: photocurrent proportional to the shown irradiance, everything else as
// device.h says; figures of one cell.
struct BaseFit {
  Device device;
  std::vector<double> currents;
  double chi2 = 0;
  double Misfit() const;  // norm in noise units
};

// Weighted least squares from `start`: damped Gauss-Newton over photocurrent, logarithm of the
// diode's current near the open circuit, ideality, resistance and conductance, the last two >= 0.
BaseFit FitBase(const Device& start, const Plan& plan, const std::vector<double>& currents,
                const std::vector<double>& sigmas);

}  // namespace hidden
