#pragma once

#include <Eigen/Core>
#include <vector>

#include "lyrefit/diagnose/sweep_state.h"

namespace lyrefit {

// Quantities by which sweeps are compared, nearly independent of light and temperature: ln FF, Rs
// Isc / Voc, n, Gsh Voc / Isc, and the shape distance. The latter is ln of the root mean square
// difference, over the bins, between the single-diode residual and the common one, in fractions of
// Isc.
enum Quantity {
  kFill,
  kSeries,
  kJunction,
  kShunt,
  kParameterQuantities,
  kShapeOff = 4,
  kQuantities
};

// Smallest number of reference sweeps: fewer do not give a usable variance.
constexpr int kFewestReferences = 4;

// Prediction for a reference sweep at the Isc and Voc of the given sweep.
struct Expectation {
  std::vector<int> used;        // positions among the references
  std::vector<int> outliers;    // left out: outliers among the references
  int regressors = 1;           // 1, ln Isc, Voc: more with more references
  Eigen::VectorXd centre;       // ln Isc and Voc of the sweep
  Eigen::MatrixXd slopes;       // regressors x kQuantities
  Eigen::MatrixXd gram;         // X'X of the references' regressors
  Eigen::MatrixXd covariance;   // of the quantities of one sweep about the regression
  Eigen::VectorXd shape;        // median residual, in bins (NaN: too few sweeps)
  Eigen::VectorXd shape_scale;  // standard deviation of one sweep, per bin
  int degrees = 1;              // degrees of freedom of the covariance
};

// The regression on the references nearest to `sweep` in Isc and Voc, without outliers.
Expectation Expect(const std::vector<const SweepState*>& references, const SweepState& sweep);

struct Difference {
  Eigen::VectorXd value;     // of each quantity, minus `expected`
  Eigen::VectorXd expected;  // of the quantities
  double widening = 1;       // factor of the variance: adds that of the prediction
  Eigen::VectorXd shape;     // difference in bins; 0 if unknown
  std::vector<double> p;     // p-value of each quantity by itself
  double p_value = 1;        // smaller of joint (Hotelling) and single tests, corrected
};
Difference Differ(const Expectation& expected, const SweepState& sweep);

// The first kParameterQuantities quantities.
Eigen::VectorXd ParametersOf(const SweepState& state);

}  // namespace lyrefit
