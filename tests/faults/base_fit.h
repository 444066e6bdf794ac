#pragma once

#include <array>
#include <vector>

#include "faults/plan.h"

namespace faults {

// Single-diode fit to all readings. The photocurrent is proportional to the irradiance that the
// sensor shows; the other dependences are those of device.h. Parameters and currents are those of
// one cell.
struct BaseFit {
  Device device;
  std::vector<double> currents;
  double chi2 = 0;
  double Misfit() const;  // root of chi2, in noise standard deviations
};

// Weighted least squares from `start` by damped Gauss-Newton. Free parameters: photocurrent,
// logarithm of the diode current near open circuit, ideality, series resistance and shunt
// conductance. The last two are >= 0.
BaseFit FitBase(const Device& start, const Plan& plan, const std::vector<double>& currents,
                const std::vector<double>& sigmas);

}  // namespace faults
