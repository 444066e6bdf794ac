#pragma once

#include <vector>

#include "lyrefit/certify/mixture.h"
#include "lyrefit/certify/part_bound.h"

namespace lyrefit {

// What is known of the current-over-voltage laws of all mixtures that compete in a part: their values
// at given junction voltages, to within
//
//   each . |c| + radius |shared o c| + |common . c|
//
// for a combination of these values with the coefficients c.
struct KnownValues {
  Eigen::VectorXd voltage_V;
  Eigen::VectorXd value_A;
  Eigen::VectorXd each_A;
  Eigen::VectorXd shared;
  double radius_A = 0;
  Eigen::VectorXd common_A;
  double largest_light_A = 0;  // the sum of the light terms is at most this
  DualGain dual_gain;              // on leaks and diodes
};

// Bounds of the slope -dI/dVd at one junction voltage from below and at another from above.
struct SlopeRange {
  double lower = 0;
  double upper = kInfinity;
};

// The slopes of every competing mixture over the windows, at below_V[k] from below and at above_V[k]
// from above. A law is a constant less a line and exponentials, of which differences of third order
// bound the slope from one side; these differences are replaced by combinations of the known values,
// and what is left over by that is bounded for every exponential there is.
std::vector<SlopeRange> BoundSlopes(const KnownValues& known, const std::vector<Window>& windows,
                                    const std::vector<double>& below_V,
                                    const std::vector<double>& above_V, double precision_S);

}  // namespace lyrefit
