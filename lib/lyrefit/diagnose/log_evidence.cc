// Optimized fully: it runs once for each candidate.
#include "lyrefit/diagnose/fitted_candidate.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "lyrefit/base/dense.h"
#include "lyrefit/diagnose/decision_constants.h"
#include "lyrefit/diagnose/law_coordinates.h"

namespace lyrefit {
namespace {

constexpr double kLog2Pi = 1.8378770664093453;

// A prior of one coordinate at the fit: ln of its density, and the precision of a normal density of
// that width there. Where the readings say nothing, their product integrates to about one.
struct Prior {
  double log_density = 0;
  double precision = 0;
  double range = HUGE_VAL;
};

double LogHalfCauchy(double x, double scale) {
  const double z = x / scale;
  return -std::log(0.5 * M_PI * scale * (1 + z * z));
}

// Student's t with three degrees of freedom, about 0.
double LogStudent3(double x, double scale) {
  const double z = x / scale;
  return std::log(6 * std::sqrt(3.0) / M_PI / scale) - 2 * std::log(3 + z * z);
}

// Priors of the base parameters, in the coordinates of law_coordinates.h. Those of cells have heavy
// tails: thin films have idealities of 1 to 6. Modules are silicon or nearly so.
Prior BasePrior(const Law& law, const DataTraits& traits, int k, double value) {
  const auto half_cauchy = [value](double scale) {
    return Prior{LogHalfCauchy(value, scale), 2 / (scale * scale + value * value), HUGE_VAL};
  };
  if (k == IdealityIndex(0)) {
    const double off = std::log(value / kUsualIdeality);
    const double z = off / kIdealityWidthOfModules;
    const double log_density = traits.module
                                   ? -0.5 * (z * z + kLog2Pi) - std::log(kIdealityWidthOfModules)
                                   : LogStudent3(off, kIdealityWidthOfCells);
    const double width =
        value * (traits.module ? kIdealityWidthOfModules : std::hypot(kIdealityWidthOfCells, off));
    return {log_density - std::log(value), 1 / (width * width), HUGE_VAL};
  }
  if (k == kRs) return half_cauchy(kUsualSeriesDrop);
  if (k == kRsh) return half_cauchy(kUsualLeak);
  if (law.model == Model::kDoubleDiode && k == SaturationCurrentIndex(1)) {
    return half_cauchy(kUsualSecondDiode);
  }
  return {0, 1e-2, HUGE_VAL};  // the same in every law
}

// About the neutral value where a usual size is known, else uniform between the bounds. A parameter
// without finite bounds belongs to every law compared.
Prior EffectPrior(const EffectParameter& parameter, double value) {
  constexpr double kUnbounded = 1e3;
  const double range = parameter.upper - parameter.lower;
  if (!(range < kUnbounded)) return {0, 1e-6, HUGE_VAL};
  if (parameter.usual > 0) {
    const bool two_sided = parameter.lower < parameter.neutral;
    const double off = value - parameter.neutral, usual = parameter.usual;
    const double log_density = LogStudent3(off, usual) + (two_sided ? 0 : std::log(2.0));
    return {log_density, 4 / (3 * usual * usual + off * off), range};
  }
  return {-std::log(range), 12 / (range * range), range};
}

// ln of the number of probe settings among which an effect's fixed parameters are selected.
double LogSettings(const Effect& effect, const DataTraits& traits) {
  if (effect.probes == nullptr) return 0;
  std::set<std::vector<double>> settings;
  for (const Probe& probe : effect.probes(traits)) {
    std::vector<double> values;
    for (int k = 0; k < effect.size(); ++k) {
      if (effect.parameters[k].searched) values.push_back(probe[k]);
    }
    settings.insert(values);
  }
  return std::log(std::max<double>(static_cast<double>(settings.size()), 1));
}

// Residuals of a fit with their derivatives, not whitened.
struct Linear {
  RowMatrix rows;  // derivatives by the free coordinates, by the active ones, then the residual
  int free = 0;
  int active = 0;
  std::vector<Prior> prior;  // of the free and the active ones
  std::vector<int> inward;   // of the active ones: +1 at the lower bound, -1 at the upper
  double log_settings = 0;
};

Linear LinearOf(const WeightedData& weighted, const LawFit& fit) {
  const Readings& readings = *weighted.readings;
  const LawCoordinates coordinates(fit.law, readings);
  const LeastSquaresProblem problem = coordinates.Problem();
  const std::vector<double> theta = coordinates.Of(fit.p);
  const int count = problem.residuals, size = fit.law.size();
  LawWorkspace workspace;
  std::vector<double> current(count);
  RowMatrix jacobian = RowMatrix::Zero(count, size);
  Linear linear;
  if (!coordinates.Evaluate(theta.data(), &workspace, current.data(), jacobian.data(),
                            &problem.fixed) ||
      !jacobian.allFinite()) {
    return linear;
  }
  Eigen::VectorXd residual(count);
  for (int k = 0; k < count; ++k) residual[k] = current[k] - readings.points[k].current;
  std::vector<int> free, active;
  for (int k = 0; k < size; ++k) {
    if (problem.fixed[k] != 0 || !(jacobian.col(k).norm() > 0)) continue;
    const double slack = 1e-6 * (problem.upper[k] - problem.lower[k]);
    const bool low = theta[k] <= problem.lower[k] + slack;
    const bool high = theta[k] >= problem.upper[k] - slack;
    (low || high ? active : free).push_back(k);
    if (low || high) linear.inward.push_back(low ? 1 : -1);
  }
  linear.free = static_cast<int>(free.size());
  linear.active = static_cast<int>(active.size());
  linear.rows.resize(count, linear.free + linear.active + 1);
  int column = 0;
  for (const std::vector<int>* list : {&free, &active}) {
    for (const int k : *list) {
      linear.rows.col(column++) = jacobian.col(k);
      const EffectParameter* own = fit.law.EffectParameterAt(k);
      linear.prior.push_back(own != nullptr ? EffectPrior(*own, theta[k])
                                            : BasePrior(fit.law, readings.traits, k, theta[k]));
    }
  }
  linear.rows.col(column) = residual;
  for (const Effect* effect : fit.law.effects) {
    linear.log_settings += LogSettings(*effect, readings.traits);
  }
  return linear;
}

// ln of the integral of exp(-gradient x - curvature x^2 / 2) over x > 0, at most `range` long.
double LogInside(double gradient, double curvature, double range) {
  constexpr double kLarge = 5;
  const double root = std::sqrt(2 * curvature);
  if (!(root > 0)) return std::log(range);
  const double z = gradient / root;
  const double scaled =
      z < kLarge ? std::exp(z * z) * std::erfc(z) : (1 - 0.5 / (z * z)) / (z * std::sqrt(M_PI));
  return std::min(std::log(std::sqrt(M_PI) / root * scaled), std::log(range));
}

// ln of likelihood times priors, integrated over the parameters, for one error model.
double LogIntegral(const WeightedData& weighted, const ErrorModel& errors, const Linear& linear) {
  RowMatrix rows = linear.rows;
  const double log_determinant = Whiten(errors, weighted.used, rows);
  const Eigen::MatrixXd all = rows;
  const Eigen::MatrixXd products = TransposedTimes(all, all);
  const int free = linear.free, last = free + linear.active;
  Eigen::MatrixXd precision = products.topLeftCorner(free, free);
  for (int k = 0; k < free; ++k) precision(k, k) += linear.prior[k].precision;
  Eigen::VectorXd by = products.col(last).head(free), step;
  if (!SolvePositive(precision, by, &step)) return -HUGE_VAL;
  const double count = weighted.count();
  double sum = products(last, last) - by.dot(step);
  const double variance =
      std::max({sum / std::max(count - free, 1.0), weighted.least_variance, 1e-300});
  precision = products.topLeftCorner(free, free) / variance;
  for (int k = 0; k < free; ++k) precision(k, k) += linear.prior[k].precision;
  by /= variance;
  if (!SolvePositive(precision, by, &step)) return -HUGE_VAL;
  sum = products(last, last) / variance - by.dot(step);
  const Eigen::MatrixXd root = LowerRoot(precision);
  double value = -0.5 * (log_determinant + count * std::log(variance) + sum) - linear.log_settings;
  for (int k = 0; k < free; ++k) {
    value += linear.prior[k].log_density + 0.5 * kLog2Pi - std::log(root(k, k));
  }
  for (int a = 0; a < linear.active; ++a) {
    const int k = free + a;
    const Eigen::VectorXd mixed = products.col(k).head(free) / variance;
    Eigen::VectorXd shared;
    if (!SolvePositive(precision, mixed, &shared)) return -HUGE_VAL;
    const double curvature = products(k, k) / variance - mixed.dot(shared);
    const double gradient = products(k, last) / variance - mixed.dot(step);
    value += linear.prior[k].log_density +
             LogInside(linear.inward[a] * gradient,
                       std::max(curvature, 0.0) + linear.prior[k].precision, linear.prior[k].range);
  }
  return std::isfinite(value) ? value : -HUGE_VAL;
}

}  // namespace

double LogSum(double a, double b) {
  const double top = std::max(a, b);
  return std::isfinite(top) ? top + std::log(std::exp(a - top) + std::exp(b - top)) : top;
}

LogEvidence FindLogEvidence(const WeightedData& weighted, const LawFit& fit,
                            const DeparturePrior& departure) {
  // Sizes of the departure on a grid, a factor of sqrt(2) apart, up to a seventh of Isc.
  constexpr double kLeast = 1e-4, kRatio = 0.34657359027997264;
  constexpr int kSizes = 22;
  LogEvidence evidence;
  const Linear linear = LinearOf(weighted, fit);
  if (linear.prior.empty()) return evidence;
  WeightedData own = weighted;
  if (departure.center == 0 || departure.width == 0 || weighted.correlation > 0) {
    own.path = weighted.correlation > 0 ? 0 : departure.center;
    evidence.path = own.path;
    evidence.complete = LogIntegral(own, ErrorsOf(own), linear);
    if (weighted.correlation > 0) return evidence;
  }
  double best = -HUGE_VAL;
  const int incomplete_sizes =
      kSizes - static_cast<int>(std::ceil(std::log(kUnknownDeparture / kLeast) / kRatio));
  for (int k = 0; k < kSizes; ++k) {
    own.path = kLeast * std::exp(kRatio * k);
    const bool large = own.path >= kUnknownDeparture;
    if (departure.width == 0 && !large) continue;
    const double value = LogIntegral(own, ErrorsOf(own), linear);
    if (large) {
      evidence.incomplete = LogSum(evidence.incomplete, value - std::log(incomplete_sizes));
    }
    if (departure.width == 0) continue;
    const double off = std::log(own.path / departure.center) / departure.width;
    const double weighed =
        value - 0.5 * off * off - 0.5 * kLog2Pi + std::log(kRatio / departure.width);
    evidence.complete = LogSum(evidence.complete, weighed);
    if (weighed > best) {
      best = weighed;
      evidence.path = own.path;
    }
  }
  return evidence;
}

}  // namespace lyrefit
