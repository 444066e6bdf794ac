#include "lyrefit/estimate/refine/least_squares.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/dense.h"

namespace lyrefit {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Limit of consecutive steps that cannot be evaluated; beyond it the descent ends.
constexpr int kMostInvalid = 20;
constexpr double kLeastRadius = 1e-32, kLargestRadius = 1e16;

// A point of the descent. `evaluate` fills the memory of `jacobian`: one column per residual.
struct Place {
  VectorXd p;
  VectorXd residuals;
  MatrixXd jacobian;
  double sum = 0;
};

bool Evaluate(const LeastSquaresProblem& problem, Place* place) {
  if (!problem.evaluate(place->p.data(), place->residuals.data(), place->jacobian.data())) {
    return false;
  }
  place->sum = place->residuals.squaredNorm();
  return std::isfinite(place->sum);
}

// The quadratic model of the sum of squares around a point: half of it falls by -(gradient' d + d'
// gram d / 2).
struct Quadratic {
  MatrixXd gram;
  VectorXd gradient;
  VectorXd scale;         // squared lengths of the columns
  std::vector<int> free;  // parameters that move and have no active bound
};

Quadratic Expand(const LeastSquaresProblem& problem, const Place& place) {
  Quadratic model;
  model.gram = TimesTransposed(place.jacobian);
  model.gradient = Times(place.jacobian, place.residuals);
  model.scale = model.gram.diagonal().cwiseMax(1e-12);
  for (int k = 0; k < place.p.size(); ++k) {
    if (!problem.fixed.empty() && problem.fixed[k] != 0) continue;
    const bool pressed = (place.p[k] <= problem.lower[k] && model.gradient[k] >= 0) ||
                         (place.p[k] >= problem.upper[k] && model.gradient[k] <= 0);
    if (!pressed) model.free.push_back(k);
  }
  return model;
}

// The damped step in the parameters of `free`; the others move by the given `step`.
bool SolveFree(const Quadratic& model, const std::vector<int>& free, double radius,
               VectorXd* step) {
  const int count = static_cast<int>(free.size());
  MatrixXd gram(count, count);
  VectorXd pull(count), scale(count), x;
  for (int a = 0; a < count; ++a) {
    (*step)[free[a]] = 0;
    scale[a] = 1 / std::sqrt(model.scale[free[a]]);
  }
  for (int a = 0; a < count; ++a) {
    pull[a] = -scale[a] * (model.gradient[free[a]] + model.gram.col(free[a]).dot(*step));
    for (int b = 0; b < count; ++b) {
      gram(a, b) = scale[a] * scale[b] * model.gram(free[a], free[b]);
    }
    gram(a, a) += 1 / radius;
  }
  if (!SolvePositive(gram, pull, &x) || !x.allFinite()) return false;
  for (int a = 0; a < count; ++a) (*step)[free[a]] = scale[a] * x[a];
  return true;
}

// The end of the damped step. A parameter that meets its bound first is fixed there, and the step
// continues in the others: the model's sum of squares falls all the way.
bool TakeStep(const LeastSquaresProblem& problem, const Quadratic& model, const VectorXd& from,
              double radius, VectorXd* to) {
  std::vector<int> free = model.free;
  VectorXd step = VectorXd::Zero(from.size());
  *to = from;
  while (!free.empty()) {
    const VectorXd before = step;
    if (!SolveFree(model, free, radius, &step)) return false;
    double reach = 1;
    int first = -1;
    for (const int k : free) {
      if (step[k] == before[k]) continue;
      const double bound = step[k] < before[k] ? problem.lower[k] : problem.upper[k];
      const double room = (bound - from[k] - before[k]) / (step[k] - before[k]);
      if (!(room < reach)) continue;
      reach = std::max(room, 0.0);
      first = k;
    }
    for (const int k : free) {
      step[k] = before[k] + reach * (step[k] - before[k]);
      (*to)[k] = std::min(std::max(from[k] + step[k], problem.lower[k]), problem.upper[k]);
    }
    if (first < 0) break;
    const bool down = (*to)[first] - problem.lower[first] < problem.upper[first] - (*to)[first];
    (*to)[first] = down ? problem.lower[first] : problem.upper[first];
    step[first] = (*to)[first] - from[first];
    free.erase(std::find(free.begin(), free.end(), first));
  }
  return true;
}

// Predicted decrease of the sum of squares.
double Predicted(const Quadratic& model, const VectorXd& step) {
  return -2 * model.gradient.dot(step) - step.dot(Times(model.gram, step));
}

bool IsTiny(const VectorXd& step, const VectorXd& p) {
  constexpr double kParameterTolerance = 1e-12;
  return step.norm() <= kParameterTolerance * (p.norm() + kParameterTolerance);
}

// Trust radius, controlled by the ratio of actual to predicted decrease (Nielsen 1999, "Damping
// parameter in Marquardt's method").
struct Trust {
  double radius;
  double shrink = 2;

  void Shorten() {
    radius /= shrink;
    shrink *= 2;
  }
  void Lengthen(double quality) {
    radius /= std::max(1.0 / 3, 1 - std::pow(2 * quality - 1, 3));
    radius = std::min(radius, kLargestRadius);
    shrink = 2;
  }
};

// Part of a step at the minimum of the parabola through its start, with the slope there, and its
// end. For steps with too small a decrease.
double BestPart(const Quadratic& model, const VectorXd& step, double gained) {
  const double slope = -2 * model.gradient.dot(step);
  return std::min(std::max(slope / (2 * (slope - gained)), 0.1), 0.5);
}

LeastSquaresEnd Descend(const LeastSquaresProblem& problem, const LeastSquaresOptions& options,
                        Place here) {
  // A nearly undamped step without a predicted decrease is not tried. Nor is one whose predicted
  // decrease, times kMany, does not reach the cutoff.
  constexpr double kLeastQuality = 1e-3, kMany = 10;
  LeastSquaresEnd end;
  end.usable = true;
  Place next = here;
  Quadratic model = Expand(problem, here);
  Trust trust{options.trust_radius};
  const double hardly_damped = 0.1 * options.trust_radius;
  int invalid = 0;
  while (!model.free.empty() && end.iterations < options.max_iterations &&
         trust.radius > kLeastRadius && invalid <= kMostInvalid && here.sum > options.target) {
    end.stopped = options.stop.Stopped();
    if (end.stopped) break;
    ++end.iterations;
    const bool solved = TakeStep(problem, model, here.p, trust.radius, &next.p);
    const VectorXd step = next.p - here.p;
    const double predicted = solved ? Predicted(model, step) : 0;
    const double negligible = options.function_tolerance * here.sum;  // decrease
    const bool promising = predicted > negligible || trust.radius < hardly_damped;
    end.converged = solved && (IsTiny(step, here.p) || !promising);
    end.hopeless = !end.converged && trust.radius >= hardly_damped &&
                   here.sum - kMany * predicted > options.cutoff;
    if (end.converged || end.hopeless) break;
    if (!solved || !Evaluate(problem, &next)) {
      ++invalid;
      trust.Shorten();
      continue;
    }
    invalid = 0;
    double gained = here.sum - next.sum;
    end.converged = std::fabs(gained) <= negligible;
    if (gained > kLeastQuality * predicted) {
      trust.Lengthen(gained / predicted);
    } else if (!end.converged) {
      next.p = here.p + BestPart(model, step, gained) * step;
      gained = Evaluate(problem, &next) ? here.sum - next.sum : 0;
      if (!(gained > kLeastQuality * predicted)) trust.Shorten();
    }
    if (gained > 0) std::swap(here, next);
    if (end.converged) break;
    if (gained > 0) model = Expand(problem, here);
  }
  end.converged = end.converged || model.free.empty();
  end.p.assign(here.p.begin(), here.p.end());
  end.sum_of_squares = here.sum;
  return end;
}

}  // namespace

LeastSquaresEnd SolveLeastSquares(const LeastSquaresProblem& problem,
                                  const std::vector<double>& start,
                                  const LeastSquaresOptions& options) {
  const int size = static_cast<int>(start.size());
  Place first{Eigen::Map<const VectorXd>(start.data(), size), VectorXd(problem.residuals),
              MatrixXd(size, problem.residuals)};
  for (int k = 0; k < size; ++k) {
    if (!problem.fixed.empty() && problem.fixed[k] != 0) continue;
    first.p[k] = std::min(std::max(start[k], problem.lower[k]), problem.upper[k]);
  }
  LeastSquaresEnd end;
  end.p.assign(first.p.begin(), first.p.end());
  if (!first.p.allFinite() || !Evaluate(problem, &first)) return end;
  return Descend(problem, options, std::move(first));
}

}  // namespace lyrefit
