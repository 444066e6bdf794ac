#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/estimate/refine/error_model.h"
#include "lyrefit/estimate/refine/least_squares.h"
#include "lyrefit/model/device.h"
#include "lyrefit/model/law.h"
#include "lyrefit/model/reading.h"

namespace lyrefit {

// Data to which laws are fitted: readings, their noise, and which of them are used.
struct WeightedData {
  std::shared_ptr<const Readings> readings;
  std::vector<double> sigma;
  std::vector<char> used;  // 0: left out, as an outlier or held out
  double correlation = 0;  // of the noise at lag 1
  // Standard deviation of a rough path along each curve, in current scales at the brightest light.
  // estimate/refine/error_model.h defines the path.
  double path = 0;
  double path_length = 1;  // correlation length of the path, in pivot voltages
  // The noise variance is scaled to the residuals, but not below this fraction of sigma^2. 1: sigma
  // contains more than noise.
  double least_variance = 0;
  ProgressReporter progress;  // after a stop request, fits end at their present parameters

  int count() const;  // number of used readings
};

// Error model of the readings.
ErrorModel ErrorsOf(const WeightedData& weighted);

// Error of a reading of a Suns-Voc trace beside the sweep, in current scales; 0 for others. The two
// are measured one after the other: their voltages are some 2 mV per cell apart, as of 1 K.
double TraceError(const std::vector<Reading>& points, std::size_t k);

// Transforms values so that noise becomes white with unit variance: divides by sigma and removes
// the correlation of neighbours. Left-out readings become 0. One row per reading.
Eigen::VectorXd Whiten(const WeightedData& weighted, const Eigen::VectorXd& values);
Eigen::MatrixXd WhitenColumns(const WeightedData& weighted, const Eigen::MatrixXd& columns);

struct LawFit {
  Law law;
  std::vector<double> p;  // Rsh is infinite without a shunt
  double sum = 0;         // of squared whitened residuals
  bool usable = false;
  std::vector<double> current;  // of every reading, also of those left out, in scales
};

// Of the first diode.
inline double Ideality(const LawFit& fit) { return fit.p[IdealityIndex(0)]; }

// Least squares in all parameters of `law` that IsFixed (law_coordinates.h) leaves free, from the
// parameters `start`.
LawFit FitLaw(const WeightedData& weighted, const Law& law, const std::vector<double>& start,
              const LeastSquaresOptions& options = {});

// Up to this number of readings the base model is fitted even after a stop request. The fit takes a
// fraction of a second, and without it there is nothing to report.
constexpr std::size_t kQuickToFit = 2500;

// Typical base parameters of a module without a fault, as a start that does not depend on another
// fit. `light`: current under the brightest light, in scales. `giving`: see ShapeStart.
std::vector<double> TypicalStart(const Readings& readings, const Law& law, double light,
                                 double giving = 1);

// Standard deviation of the rough path by restricted maximum likelihood, given the noise and a
// prior from modules without a fault. In current scales.
double FindPath(const WeightedData& weighted, const LawFit& fit);

// Fits the base model from several starts and returns the best fit.
LawFit FitBase(const WeightedData& weighted, const Law& law);

// Linearization of a fit: whitened residuals (model - measured) and their derivatives by the free
// coordinates (law_coordinates.h), i.e. those neither fixed nor active at a bound.
struct Linearized {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
  std::vector<int> free;
  Eigen::MatrixXd slopes;  // derivatives of all parameters by the free coordinates
  Eigen::MatrixXd basis;   // orthonormal basis of the jacobian's columns
};
Linearized Linearize(const WeightedData& weighted, const LawFit& fit);

// Standard errors of all parameters (0 if not free), for unit noise.
std::vector<double> StandardErrors(const Linearized& linear);

// Standard error of a value with this derivative by all coordinates, for unit noise.
double StandardError(const Linearized& linear, const std::vector<double>& derivative);

// Lack of fit of a fit to `currents`: root mean square over the used readings, in scales, of their
// distance from the fit, projected off the law's parameters. All readings have equal weight but those
// of a Suns-Voc trace, which has its error besides and does not count.
double LackOfFit(const WeightedData& weighted, const LawFit& fit,
                 const std::vector<double>& currents);
// Version with the basis of PlainBasis given, which does not depend on the currents.
Eigen::MatrixXd PlainBasis(const WeightedData& weighted, const LawFit& fit);
double LackOfFit(const WeightedData& weighted, const LawFit& fit,
                 const Eigen::MatrixXd& plain_basis, const std::vector<double>& currents);

// RMSE in ampere over the used readings under load, including those within averages.
double RmseOf(const WeightedData& weighted, const std::vector<double>& current);

// Lack of fit of a fit to its readings.
double MissedBy(const WeightedData& weighted, const LawFit& fit);

// Number of free parameters of a law on these data.
int FreeCount(const WeightedData& weighted, const Law& law);

// Degrees of freedom: used readings minus free parameters, at least 1.
int Degrees(const WeightedData& weighted, const Law& law);

// Mean square of the whitened residuals: 1 if sigma is the noise and the law is correct.
double SquarePerDegree(const WeightedData& weighted, const LawFit& fit);

// Variance of the noise in units of sigma^2: SquarePerDegree, but at least `least_variance`.
double NoiseVariance(const WeightedData& weighted, const LawFit& fit);

// Half-width of a normal 95 % interval in standard deviations. Used for sizes and for scatter
// between modules, where the degrees of freedom of one fit do not apply.
constexpr double kNormal95 = 1.96;

// Largest number of parameters of an effect, so that it fits into a law with the largest base.
constexpr int kMostEffectParameters = 11;

// Whether an effect can be added to a law: it is not yet part of it, compatible with its effects,
// and the number of parameters stays within the limit.
bool CanAdd(const Law& law, const Effect& effect);

// Position of the first parameter of an effect that is part of the law.
int ParametersAt(const Law& law, const Effect& effect);

}  // namespace lyrefit
