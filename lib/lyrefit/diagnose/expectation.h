#pragma once

#include <Eigen/Core>
#include <vector>

#include "lyrefit/diagnose/sweep_state.h"

namespace lyrefit {

// What sweeps are compared by, as numbers that hardly depend on light and temperature: ln FF,
// Rs Isc / Voc, n, Gsh Voc / Isc, and ln of how far the shape of what a single diode misses lies
// from the common one (root mean square over the bins, in parts of Isc).
enum Quantity {
  kFill,
  kSeries,
  kJunction,
  kShunt,
  kParameterQuantities,
  kShapeOff = 4,
  kQuantities
};

// Sweeps that may be expected to be alike; fewer are no measure of how much they differ.
constexpr int kFewestReferences = 4;

// What a reference sweep would show at the Isc and Voc of the sweep that it is made for.
struct Expectation {
  std::vector<int> used;        // positions among the references
  std::vector<int> outlier;         // left out: unlike the others
  int regressors = 1;           // 1, ln Isc, Voc: as many as the references can bear
  Eigen::VectorXd centre;       // ln Isc, Voc of the sweep
  Eigen::MatrixXd slopes;       // regressors x kQuantities
  Eigen::MatrixXd gram;         // of the references' regressors
  Eigen::MatrixXd covariance;   // of one sweep's differences
  Eigen::VectorXd shape;        // common, in bins (NaN where hardly any sweep has readings)
  Eigen::VectorXd shape_scale;  // standard deviations of one sweep's
  int degrees = 1;              // of the covariance
};

// The references nearest to `sweep` in Isc and Voc, outliers left out.
Expectation Expect(const std::vector<const SweepState*>& references, const SweepState& sweep);

struct Difference {
  Eigen::VectorXd value;     // of the quantities
  Eigen::VectorXd expected;  // of the quantities
  double widening = 1;       // of the variance: the expectation has its own
  Eigen::VectorXd shape;     // in bins; 0 where nothing is known
  std::vector<double> p;     // of each quantity by itself
  double p_value = 1;        // of all together (Hotelling) and each by itself, whichever says more
};
Difference Differ(const Expectation& expected, const SweepState& sweep);

// The first four quantities.
Eigen::VectorXd ParametersOf(const SweepState& state);

}  // namespace lyrefit
