#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// Number of equal bins of V / Voc, from 0 to 1, in which shapes are compared.
constexpr int kShapeBins = 16;

// Quantities of a sweep for comparison with other sweeps, from a single-diode fit with equal
// weights. Equal weights give the best repeatability; weights by noise would vary from day to day.
struct SweepState {
  std::string name;
  int cells = 1;
  Setup setup = Setup::kUnknown;
  double irradiance_W_m2 = 0;  // NaN if not stated
  double temperature_C = 0;    // NaN if not stated
  double isc_A = 0;            // isc, voc, fill factor and maximum power are of the model
  double voc_V = 0;
  double fill_factor = 0;
  double max_power_W = 0;
  double photocurrent_A = 0;
  double ideality = 0;
  double series_ohm = 0;
  double shunt_S = 0;
  // V / Voc of each reading (ascending), and measured minus model current in fractions of Isc.
  // `shape`: means of the latter in kShapeBins bins (NaN in empty bins).
  std::vector<double> place, off;
  Eigen::VectorXd shape;
};

// A fitted sweep, with all that a fit of changed readings needs.
struct FittedSweep {
  WeightedData weighted;
  LawFit fit;
  SweepState state;
};

// Fits a single diode to one sweep. Errors: readings that a diagnosis rejects, a dark curve, no
// usable fit, no Voc or maximum power.
Expected<FittedSweep> FitSweep(const IvCurve& curve);

// State of the sweep after `change` (one value per reading, in current scales) is added to the
// currents. If the new fit fails, the old state.
SweepState StateWith(const FittedSweep& sweep, const std::vector<double>& change);

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
