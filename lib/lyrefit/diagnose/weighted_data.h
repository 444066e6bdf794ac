#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "lyrefit/diagnose/watch.h"
#include "lyrefit/law/law.h"
#include "lyrefit/law/reading.h"
#include "lyrefit/refine/error_model.h"
#include "lyrefit/refine/least_squares.h"

namespace lyrefit {

// What laws are fitted to: readings, how far each is trusted, and which of them count.
struct WeightedData {
  std::shared_ptr<const Readings> readings;
  std::vector<double> sigma;
  std::vector<char> used;  // 0: left out, as an outlier or for a held-out gain
  double correlation = 0;  // lag 1, of the noise
  // Of a rough path along each curve, in current scales at the brightest light: see
  // refine/error_model.h, with a length of one open-circuit voltage.
  double path = 0;
  double path_length = 1;  // in pivot voltages
  // The noise's size follows the residuals, but its variance is not taken below this part of
  // sigma^2: 1 where sigma holds more than noise.
  double least_variance = 0;
  Watch* watch = nullptr;  // once it says stop, fits end where they are

  int count() const;  // of used readings
};

// Whether fits leave a parameter where it is.
bool Held(const Readings& readings, const Law& law, int parameter);

// Errors of the readings.
ErrorModel ErrorsOf(const WeightedData& weighted);

// Divides by the noise and takes the neighbours' correlation out, so that white noise of unit size
// remains. Left-out readings become 0.
Eigen::VectorXd Whiten(const WeightedData& weighted, const Eigen::VectorXd& values);
Eigen::MatrixXd WhitenColumns(const WeightedData& weighted, const Eigen::MatrixXd& columns);

struct LawFit {
  Law law;
  std::vector<double> p;
  double sum = 0;  // of squared whitened residuals
  bool usable = false;
  std::vector<double> current;  // of every reading, left out or not
};

// Least squares in all parameters of `law` that are not `searched`, from `start`.
LawFit FitLaw(const WeightedData& weighted, const Law& law, const std::vector<double>& start,
              const LeastSquaresOptions& options = {});

// The base model of this many readings is fitted even where a stop was asked for already: it takes
// a fraction of a second, and without it there is nothing to report.
constexpr std::size_t kQuickToFit = 2500;

// Base parameters of a healthy module whose cells under full light carry `light` (in scales), for
// fits that stand on no other.
std::vector<double> TypicalStart(const Readings& readings, const Law& law, double light);

// Size of the rough path in a fit's residuals, by restricted maximum likelihood given the noise and
// what healthy modules have.
double FindPath(const WeightedData& weighted, const LawFit& fit);

// The base model from several starts.
LawFit FitBase(const WeightedData& weighted, const Law& law);

// The fit's linear picture: whitened residual (model - measured) and its derivatives by the
// parameters that are free to move, i.e. neither held nor pressed against a bound.
struct Linearized {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
  std::vector<int> free;
  Eigen::MatrixXd basis;  // orthonormal, of the jacobian's columns
};
Linearized Linearize(const WeightedData& weighted, const LawFit& fit);

// Standard errors of all parameters (0 where not free), for unit noise.
std::vector<double> StandardErrors(const Linearized& linear, int parameters);

// Of a value with this derivative by all parameters, for unit noise.
double StandardError(const Linearized& linear, const std::vector<double>& derivative);

// Root mean square over the readings used, in scales, of what a fit's law at its best would still
// miss of `currents`: noise, weights and what lies along its parameters do not count.
double LackOfFit(const WeightedData& weighted, const LawFit& fit, const std::vector<double>& currents);
// The same with what lies along the fit's parameters given, which is the same for all currents.
Eigen::MatrixXd PlainBasis(const WeightedData& weighted, const LawFit& fit);
double LackOfFit(const WeightedData& weighted, const LawFit& fit, const Eigen::MatrixXd& plain_basis,
                 const std::vector<double>& currents);

// Free parameters of a law on these data.
int FreeCount(const WeightedData& weighted, const Law& law);

// What the readings have beyond them, at least 1.
int Degrees(const WeightedData& weighted, const Law& law);

// Mean square of whitened residuals: 1 where sigma is the noise and the law is right.
double SquarePerDegree(const WeightedData& weighted, const LawFit& fit);

// The same as the variance of the noise in units of sigma, which is not taken below what it
// allows.
double NoiseVariance(const WeightedData& weighted, const LawFit& fit);

// Half of a normal's 95 % interval in standard deviations: for sizes and for what scatters from
// module to module, where the degrees of freedom of one fit say nothing.
constexpr double kNormal95 = 1.96;

// Beside the largest base an effect may have the rest.
constexpr int kMostEffectParameters = 11;

// Whether a law has room for an effect, which is not there already nor anything it cannot stand
// beside.
bool CanAdd(const Law& law, const Effect& effect);

}  // namespace lyrefit
