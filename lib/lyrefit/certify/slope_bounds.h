#pragma once

#include <vector>

#include "lyrefit/certify/mixture.h"
#include "lyrefit/certify/part_bound.h"

namespace lyrefit {

// Enclosure of the current of all competing mixtures of a part at given junction voltages. (A
// mixture competes if it is as good as the best one known.) A combination of the values with the
// coefficients c is known to within
//
//   each . |c| + radius |shared o c| + |common . c|
//
// where o is the product by element. Vectors have one element per voltage.
struct KnownValues {
  Eigen::VectorXd voltage_V;
  Eigen::VectorXd value_A;
  Eigen::VectorXd each_A;
  Eigen::VectorXd shared;
  double radius_A = 0;
  Eigen::VectorXd common_A;
  double largest_light_A = 0;  // upper bound of the sum of the light terms
  DarkCurrentBound dark_bound;
};

// Bounds of the slope -dI/dVd, in S: `lower` at one junction voltage, `upper` at another.
struct SlopeRange {
  double lower = 0;
  double upper = kInfinity;
};

// Bounds the slopes of every competing mixture over the windows: from below at below_V[k] and from
// above at above_V[k]. A law is a constant less a line and exponentials, so differences of third
// order bound its slope from one side. These differences are replaced by combinations of the known
// values. The remainder is bounded over all exponentials of the windows. Remainders below
// `precision_S` are not bounded more closely.
std::vector<SlopeRange> BoundSlopes(const KnownValues& known, const std::vector<Window>& windows,
                                    const std::vector<double>& below_V,
                                    const std::vector<double>& above_V, double precision_S);

}  // namespace lyrefit
