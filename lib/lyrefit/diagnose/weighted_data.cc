#include "lyrefit/diagnose/weighted_data.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lyrefit/base/dense.h"
#include "lyrefit/diagnose/law_coordinates.h"
#include "lyrefit/estimate/refine/error_sizes.h"
#include "lyrefit/model/default_values.h"

namespace lyrefit {
namespace {

// A device departs from its model alike in both directions of a sweep: the path of a curve runs along
// the voltage.
void OrderByVoltage(const std::vector<Reading>& points, double unit, ErrorModel* errors) {
  std::vector<int>& order = errors->order;
  order.resize(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    if (points[a].curve != points[b].curve) return points[a].curve < points[b].curve;
    return points[a].voltage < points[b].voltage;
  });
  for (std::size_t k = 0; k < points.size(); ++k) errors->position[k] = points[k].voltage / unit;
}

}  // namespace

double TraceError(const std::vector<Reading>& points, std::size_t k) {
  constexpr double kApart_V = 2e-3;
  if (!points[k].suns_voc) return 0;
  const auto beside = [&](std::size_t i) { return points[i].curve == points[k].curve ? i : k; };
  const Reading& a = points[beside(k > 0 ? k - 1 : k)];
  const Reading& b = points[beside(k + 1 < points.size() ? k + 1 : k)];
  const double span = b.voltage - a.voltage;
  return span != 0 ? kApart_V * std::fabs((b.current - a.current) / span) : 0;
}

ErrorModel ErrorsOf(const WeightedData& weighted) {
  const std::vector<Reading>& points = weighted.readings->points;
  ErrorModel errors;
  errors.white = weighted.sigma;
  if (weighted.correlation == 0 && weighted.path == 0) return errors;
  const bool neighbours = weighted.correlation > 0;
  const double voltage = weighted.readings->pivot_voltage;
  const double apart = neighbours ? -std::log(weighted.correlation) : 0;
  double brightest = 0, at = 0;
  for (const Reading& r : points) brightest = std::max(brightest, r.irradiance);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Reading& r = points[k];
    const double step = k > 0 ? std::fabs(r.voltage - points[k - 1].voltage) / voltage : 0;
    at += neighbours ? apart : step / weighted.path_length;
    const double light = brightest > 0 ? r.irradiance / brightest : 0;
    const double departure = std::hypot(weighted.path * light, TraceError(points, k));
    errors.position.push_back(at);
    errors.path.push_back(neighbours ? weighted.sigma[k] : r.dark ? 0 : departure);
    errors.chain.push_back(neighbours ? r.segment : r.curve);
  }
  if (neighbours) errors.white.assign(points.size(), 0);
  if (!neighbours && weighted.readings->traits.up_down)
    OrderByVoltage(points, voltage * weighted.path_length, &errors);
  return errors;
}

namespace {

Whitening WhiteningOf(const WeightedData& weighted) {
  return Whitening(ErrorsOf(weighted), weighted.used);
}

// Evaluates whitened residuals and derivatives. The solver accepts failed residuals of a step, but
// not missing derivatives, so these become 0 if they cannot be evaluated.
bool EvaluateWhitened(const WeightedData& weighted, const Whitening& whitening,
                      const LawCoordinates& law, const std::vector<char>& fixed,
                      const double* theta, LawWorkspace* workspace, std::vector<double>* current,
                      double* residuals, double* jacobian) {
  const Readings& readings = *weighted.readings;
  const int count = static_cast<int>(readings.points.size());
  const int size = static_cast<int>(fixed.size());
  if (jacobian == nullptr && weighted.progress.Stopped()) return false;
  if (!law.Evaluate(theta, workspace, current->data(), jacobian, &fixed)) {
    if (jacobian == nullptr) return false;
    if (!law.Evaluate(theta, workspace, current->data(), nullptr)) return false;
    std::fill(jacobian, jacobian + static_cast<std::ptrdiff_t>(count) * size, 0.0);
  }
  Eigen::Map<RowMatrix> r(residuals, count, 1);
  for (int k = 0; k < count; ++k) r(k, 0) = (*current)[k] - readings.points[k].current;
  whitening.Apply(r);
  if (!std::isfinite(r.squaredNorm())) return false;
  if (jacobian == nullptr) return true;
  Eigen::Map<RowMatrix> rows(jacobian, count, size);
  whitening.Apply(rows);
  if (!std::isfinite(rows.squaredNorm())) rows.setZero();
  return true;
}

LeastSquaresProblem MakeProblem(const WeightedData& weighted, const LawCoordinates& coordinates,
                                LawWorkspace* workspace, std::vector<double>* current) {
  LeastSquaresProblem problem = coordinates.Problem();
  current->resize(problem.residuals);
  problem.evaluate = [&weighted, whitening = WhiteningOf(weighted), &coordinates,
                      fixed = problem.fixed, workspace,
                      current](const double* theta, double* residuals, double* jacobian) {
    return EvaluateWhitened(weighted, whitening, coordinates, fixed, theta, workspace, current,
                            residuals, jacobian);
  };
  return problem;
}

// `light`: current under the brightest light, in scales.
std::vector<double> BaseStart(const Readings& readings, const Law& law, double light, double n,
                              double resistance) {
  double brightest = 0;
  for (const Reading& r : readings.points) brightest = std::max(brightest, r.irradiance);
  std::vector<double> theta = {brightest > 0 ? light / brightest : 0, 0, n, resistance, 0.05};
  if (law.model == Model::kDoubleDiode) theta.insert(theta.end(), {0.05, kDefaultIdeality2});
  if (law.free_tempco) theta.push_back(readings.isc_tempco_per_K);
  if (law.free_bandgap) theta.push_back(readings.bandgap_eV);
  return LawCoordinates(law, readings).Parameters(theta);
}

}  // namespace

std::vector<double> TypicalStart(const Readings& readings, const Law& law, double light,
                                 double giving) {
  constexpr double kIdeality = 1.2, kResistance = 0.015;
  std::vector<double> p = BaseStart(readings, law, light, kIdeality, kResistance);
  const double exponent =
      readings.pivot_voltage / (kIdeality * ThermalVoltage(readings.reference_temperature_K));
  p[SaturationCurrentIndex(0)] *= std::exp(exponent * (1 - 1 / giving));
  return p;
}

int WeightedData::count() const {
  return static_cast<int>(std::count(used.begin(), used.end(), 1));
}

Eigen::VectorXd Whiten(const WeightedData& weighted, const Eigen::VectorXd& values) {
  RowMatrix rows = values;
  WhiteningOf(weighted).Apply(rows);
  return rows.col(0);
}

Eigen::MatrixXd WhitenColumns(const WeightedData& weighted, const Eigen::MatrixXd& columns) {
  RowMatrix rows = columns;
  WhiteningOf(weighted).Apply(rows);
  return rows;
}

LawFit FitLaw(const WeightedData& weighted, const Law& law, const std::vector<double>& start,
              const LeastSquaresOptions& options) {
  LawFit fit;
  fit.law = law;
  LawWorkspace workspace(GiveUp::kSlow);
  const LawCoordinates coordinates(law, *weighted.readings);
  const LeastSquaresProblem problem = MakeProblem(weighted, coordinates, &workspace, &fit.current);
  LeastSquaresOptions watched = options;
  watched.stop = weighted.progress.stop();
  const LeastSquaresEnd end = SolveLeastSquares(problem, coordinates.Of(start), watched);
  fit.p = coordinates.Parameters(end.p);
  fit.sum = end.sum_of_squares;
  fit.usable = end.usable && EvaluateLaw(law, *weighted.readings, fit.p.data(), &workspace,
                                         fit.current.data(), nullptr);
  return fit;
}

LawFit FitBase(const WeightedData& weighted, const Law& law) {
  LawFit best;
  for (const auto& [n, resistance] : {std::pair{1.2, 0.015}, {1.7, 0.05}, {1.2, 0.15}}) {
    LawFit fit = FitLaw(weighted, law, BaseStart(*weighted.readings, law, 1, n, resistance));
    if (fit.usable && (!best.usable || fit.sum < best.sum)) best = std::move(fit);
    if (weighted.progress.Stopped()) break;
  }
  return best;
}

Linearized Linearize(const WeightedData& weighted, const LawFit& fit) {
  const int count = static_cast<int>(weighted.readings->points.size()), size = fit.law.size();
  LawWorkspace workspace;
  std::vector<double> current;
  WeightedData unwatched = weighted;  // a fit found before a stop request is still described
  unwatched.progress = {};
  const LawCoordinates coordinates(fit.law, *weighted.readings);
  const LeastSquaresProblem problem = MakeProblem(unwatched, coordinates, &workspace, &current);
  const std::vector<double> theta = coordinates.Of(fit.p);
  Linearized linear;
  linear.residual.resize(count);
  RowMatrix jacobian = RowMatrix::Zero(count, size);
  const bool fine = problem.evaluate(theta.data(), linear.residual.data(), jacobian.data());
  if (!fine || !jacobian.allFinite() || !linear.residual.allFinite()) {
    linear.residual.setZero();
    jacobian.setZero();
  }
  const Eigen::VectorXd gradient = TransposedTimes(jacobian, linear.residual);
  for (int k = 0; k < size; ++k) {
    if (problem.fixed[k] != 0 || !(jacobian.col(k).norm() > 0)) continue;
    const double slack = 1e-9 * (problem.upper[k] - problem.lower[k]);
    const bool pressed = (theta[k] <= problem.lower[k] + slack && gradient[k] >= 0) ||
                         (theta[k] >= problem.upper[k] - slack && gradient[k] <= 0);
    if (!pressed) linear.free.push_back(k);
  }
  const Eigen::MatrixXd slopes = coordinates.Slopes(theta);
  linear.jacobian.resize(count, static_cast<int>(linear.free.size()));
  linear.slopes.resize(size, static_cast<int>(linear.free.size()));
  Eigen::MatrixXd scaled(count, static_cast<int>(linear.free.size()));
  for (std::size_t k = 0; k < linear.free.size(); ++k) {
    linear.jacobian.col(k) = jacobian.col(linear.free[k]);
    linear.slopes.col(k) = slopes.col(linear.free[k]);
    scaled.col(k) = linear.jacobian.col(k).normalized();
  }
  if (linear.free.empty()) {
    linear.basis = Eigen::MatrixXd::Zero(count, 0);
    return linear;
  }
  linear.basis = RankedBasis(scaled);
  return linear;
}

namespace {

// Standard error of a value with this derivative by the free coordinates, with columns scaled to
// unit length.
double ErrorAlong(const RightSingular& svd, const Eigen::VectorXd& derivative) {
  double variance = 0;
  for (int j = 0; j < svd.values.size(); ++j) {
    variance += std::pow(derivative.dot(svd.vectors.col(j)) / std::max(svd.values[j], 1e-12), 2);
  }
  return std::sqrt(variance);
}

RightSingular SingularOf(const Linearized& linear, const Eigen::VectorXd& lengths) {
  return FindRightSingular(linear.jacobian * lengths.cwiseInverse().asDiagonal());
}

}  // namespace

std::vector<double> StandardErrors(const Linearized& linear) {
  std::vector<double> errors(linear.slopes.rows(), 0.0);
  if (linear.free.empty()) return errors;
  const Eigen::VectorXd lengths = linear.jacobian.colwise().norm();
  const RightSingular svd = SingularOf(linear, lengths);
  for (int k = 0; k < linear.slopes.rows(); ++k) {
    const Eigen::VectorXd slope = linear.slopes.row(k);
    errors[k] = ErrorAlong(svd, slope.cwiseQuotient(lengths));
  }
  return errors;
}

double StandardError(const Linearized& linear, const std::vector<double>& derivative) {
  if (linear.free.empty()) return 0;
  const Eigen::VectorXd lengths = linear.jacobian.colwise().norm();
  Eigen::VectorXd scaled(lengths.size());
  for (int k = 0; k < lengths.size(); ++k) scaled[k] = derivative[linear.free[k]] / lengths[k];
  return ErrorAlong(SingularOf(linear, lengths), scaled);
}

int FreeCount(const WeightedData& weighted, const Law& law) {
  int count = 0;
  for (int k = 0; k < law.size(); ++k) count += IsFixed(*weighted.readings, law, k) ? 0 : 1;
  return count;
}

int Degrees(const WeightedData& weighted, const Law& law) {
  return std::max(weighted.count() - FreeCount(weighted, law), 1);
}

int ParametersAt(const Law& law, const Effect& effect) {
  const auto at = std::find(law.effects.begin(), law.effects.end(), &effect);
  CHECK(at != law.effects.end()) << effect.id << " is no effect of the law";
  return law.Offset(static_cast<int>(at - law.effects.begin()));
}

bool CanAdd(const Law& law, const Effect& effect) {
  for (const Effect* other : law.effects) {
    if (other == &effect || Exclude(*other, effect)) return false;
  }
  return law.size() + effect.size() <= kMostParameters;
}

namespace {

// The data with unit sigma and no correlation; of a Suns-Voc trace beside its error in units of a
// usual floor.
WeightedData Plain(const WeightedData& weighted) {
  constexpr double kFloor = 1e-3;
  WeightedData plain = weighted;
  plain.path = plain.correlation = 0;
  plain.progress = {};
  for (std::size_t k = 0; k < plain.sigma.size(); ++k)
    plain.sigma[k] = std::hypot(1.0, TraceError(weighted.readings->points, k) / kFloor);
  return plain;
}

}  // namespace

Eigen::MatrixXd PlainBasis(const WeightedData& weighted, const LawFit& fit) {
  return Linearize(Plain(weighted), fit).basis;
}

double LackOfFit(const WeightedData& weighted, const LawFit& fit,
                 const std::vector<double>& currents) {
  return LackOfFit(weighted, fit, PlainBasis(weighted, fit), currents);
}

double LackOfFit(const WeightedData& weighted, const LawFit& fit,
                 const Eigen::MatrixXd& plain_basis, const std::vector<double>& currents) {
  const WeightedData plain = Plain(weighted);
  Eigen::VectorXd off(static_cast<int>(currents.size()));
  for (int k = 0; k < off.size(); ++k) off[k] = currents[k] - fit.current[k];
  off = Whiten(plain, off);
  TakeOut(plain_basis, &off);
  int count = weighted.count();
  for (int k = 0; k < off.size(); ++k) {
    if (weighted.used[k] == 0 || !weighted.readings->points[k].suns_voc) continue;
    off[k] = 0;
    --count;
  }
  return off.norm() / std::sqrt(std::max(count, 1));
}

double RmseOf(const WeightedData& weighted, const std::vector<double>& current) {
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < current.size(); ++k) {
    const Reading& reading = weighted.readings->points[k];
    if (weighted.used[k] == 0 || reading.suns_voc) continue;
    const double r = current[k] - reading.current;
    sum += reading.weight * (r * r + reading.scatter);
    count += reading.weight;
  }
  return weighted.readings->scale.current_A * std::sqrt(sum / std::max(count, 1.0));
}

double MissedBy(const WeightedData& weighted, const LawFit& fit) {
  std::vector<double> currents;
  for (const Reading& r : weighted.readings->points) currents.push_back(r.current);
  return LackOfFit(weighted, fit, currents);
}

double FindPath(const WeightedData& weighted, const LawFit& fit) {
  constexpr double kLargest = 4e-3;  // of Isc; a larger departure is a cause
  constexpr int kSteps = 12;
  const ErrorPrior prior = UsualErrors(1, 1);
  WeightedData own = Plain(weighted);
  const Linearized linear = Linearize(own, fit);
  own.sigma = weighted.sigma;
  double best = -1e300, path = prior.center.path;
  for (int k = 0; k <= kSteps; ++k) {
    own.path = kLargest * std::pow(0.5, 0.5 * (kSteps - k));
    const double off = std::log(own.path / prior.center.path) / prior.width.path;
    const double likelihood =
        RestrictedLogLikelihood(ErrorsOf(own), own.used, linear.residual, linear.jacobian) -
        0.5 * off * off;
    if (likelihood <= best) continue;
    best = likelihood;
    path = own.path;
  }
  return path;
}

double SquarePerDegree(const WeightedData& weighted, const LawFit& fit) {
  return fit.sum / Degrees(weighted, fit.law);
}

double NoiseVariance(const WeightedData& weighted, const LawFit& fit) {
  return std::max({SquarePerDegree(weighted, fit), weighted.least_variance, 1e-300});
}

}  // namespace lyrefit
