#include "lyrefit/estimate/fit/refine_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/median.h"
#include "lyrefit/base/seconds.h"
#include "lyrefit/estimate/fit/intervals.h"
#include "lyrefit/estimate/fit/polish_extended.h"
#include "lyrefit/estimate/fit/reading_errors.h"
#include "lyrefit/estimate/refine/problem.h"

namespace lyrefit {
namespace {

constexpr int kGridStarts = 4;

// Degrees of freedom of the standard errors of a fit that is weighted by estimated errors.
std::vector<int> DegreesOfWeighed(const RefinedFit& fit, const FoundErrors& found) {
  const PreparedFit& prepared = fit.prepared;
  const auto errors_at = [&](const ErrorSizes& sizes) {
    const ErrorSpec spec = {ErrorKind::kField, sizes, "field"};
    const RefineProblem there = WeighByErrors(prepared.problem, prepared.fitted(), spec, fit.end.p);
    return StandardErrors({there, fit.end, prepared.spare_readings()});
  };
  return FindDegrees(found, errors_at, prepared.spare_readings());
}

// A problem with other weights, and its end.
struct WeightedEnd {
  RefineProblem problem;
  RefineEnd end;
};

// Residuals of a problem in ampere, times the roots of `weights`.
std::vector<double> WeightedResiduals(const RefineProblem& problem, const RefineEnd& end,
                                      const std::vector<double>& weights) {
  std::vector<double> residual(weights.size());
  ModelCurrents(problem.device, problem.objective, end.p.data(), problem.points, *problem.kernel,
                residual.data(), nullptr);
  for (std::size_t k = 0; k < weights.size(); ++k) {
    residual[k] = (residual[k] - problem.current_A[k]) * std::sqrt(weights[k]);
  }
  return residual;
}

// Reweights iteratively for the robust loss of `options` until the parameters are stationary (at
// most 50 rounds). The least-squares solution of the weighted problem is the robust estimate.
WeightedEnd Robustify(const FitOptions& options, const StopToken& stop, WeightedEnd fit) {
  constexpr int kRounds = 50;
  constexpr double kStationary = 1e-9;  // relative change of every parameter
  const std::vector<double> given = fit.problem.weights;
  RefineOptions how;
  how.stop = stop;
  for (int round = 0; round < kRounds && !stop.Stopped(); ++round) {
    const std::vector<double> residual = WeightedResiduals(fit.problem, fit.end, given);
    const double unit = RobustScale(residual, UpperMedian) * options.loss_scale;
    if (!(unit > 0)) break;
    std::vector<double> weights;
    weights.reserve(given.size());
    for (std::size_t k = 0; k < given.size(); ++k) {
      const double u = std::fabs(residual[k]) / unit;
      weights.push_back(given[k] *
                        (options.loss == Loss::kHuber ? HuberWeight(u, 1) : 1 / (1 + u * u)));
    }
    const RefineProblem& old = fit.problem;
    RefineProblem weighted =
        MakeRefineProblem(old.device, old.objective, old.voltage_V, old.current_A,
                          std::move(weights), old.lower, old.upper);
    weighted.kernel = old.kernel;
    fit.problem = std::move(weighted);
    const std::vector<double> before = fit.end.p;
    fit.end = Refine(fit.problem, fit.end.p, how);
    double moved = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      moved =
          std::max(moved, std::fabs(fit.end.p[i] - before[i]) / (std::fabs(before[i]) + 1e-300));
    }
    if (moved < kStationary) break;
  }
  return fit;
}

struct WeighedFit : WeightedEnd {
  ErrorReport errors;
  std::optional<FoundErrors> found;  // none if the sizes are stated
};

// Weights a fit by the errors estimated from its residuals or by the stated ones, and refits until
// both are stationary. None if there are too few readings to estimate errors.
std::optional<WeighedFit> WeighAndRefine(ErrorSpec spec, const IvCurve& curve,
                                         const StopToken& stop, const WeightedEnd& plain) {
  constexpr int kRounds = 5;
  constexpr double kSettled = 0.01;  // relative change of every size
  WeighedFit weighed{plain, {}, {}};
  ErrorReport& errors = weighed.errors;
  errors.weighed = errors.believed = true;
  errors.stated = spec.kind == ErrorKind::kStated;
  errors.current_stated = !errors.stated && !curve.sigma_A.empty();
  RefineOptions how;
  how.stop = stop;
  for (int round = 0; round < kRounds && !stop.requested(); ++round) {
    if (!errors.stated) {
      const std::optional<FoundErrors> found = FindErrors(plain.problem, curve, weighed.end, true);
      if (!found) return {};
      weighed.found = found;
      const bool settled = AreClose(found->sizes, spec.sizes, kSettled);
      spec.sizes = found->sizes;
      errors.gain = found->gain;
      if (settled) break;
    }
    weighed.problem = WeighByErrors(plain.problem, curve, spec, weighed.end.p);
    weighed.end = Refine(weighed.problem, weighed.end.p, how);
  }
  errors.sizes = spec.sizes;
  return weighed;
}

void WeighReadings(const ProgressReporter& progress, RefinedFit* fit) {
  const PreparedFit& prepared = fit->prepared;
  const ErrorSpec& spec = prepared.options.errors;
  if (spec.kind == ErrorKind::kWhite) return;
  std::optional<WeighedFit> weighed =
      WeighAndRefine(spec, prepared.fitted(), progress.stop(), {fit->problem, fit->end});
  if (!weighed) return;
  const RmsePair least_squares = BothRmse(prepared.device, fit->end.p, prepared.curve);
  fit->problem = std::move(weighed->problem);
  fit->end = std::move(weighed->end);
  fit->errors = weighed->errors;
  fit->errors->least_squares = least_squares;
  if (weighed->found) fit->degrees = DegreesOfWeighed(*fit, *weighed->found);
}

}  // namespace

PlainPolish PolishPlainly(const PreparedFit& fit, const PolishStart& candidate,
                          const ProgressReporter& progress) {
  const RefineProblem problem =
      fit.extended() ? InVariant(fit.problem, fit.variants[candidate.variant], candidate.p)
                     : fit.problem;
  RefineOptions how;
  how.stop = progress.stop();
  how.evaluation_limit = true;
  PlainPolish polish;
  Instant begin = Now();
  const RefineEnd plain = RefinePlainly(problem, candidate.p, how);
  polish.seconds = SecondsSince(begin);
  polish.rmse = BothRmse(fit.device, plain.p, fit.curve);
  begin = Now();
  polish.best_candidate = fit.extended()
                              ? Refine(problem, candidate.p, how).p
                              : PolishStarts(problem, fit.coarse, {candidate}, progress).first.p;
  polish.best_candidate_seconds = SecondsSince(begin);
  return polish;
}

RefinedFit RefineFit(const PreparedFit& fit, const std::vector<PolishStart>& candidates,
                     const SearchSpace& space, const ProgressReporter& progress) {
  const FitOptions& options = fit.options;
  ExtendedPolish polish;
  if (fit.extended()) {
    polish = PolishExtended(fit, candidates, space, progress);
  } else {
    static_cast<PolishResult&>(polish) = PolishStarts(
        fit.problem, fit.coarse, CollectStarts(fit.coarse, candidates, kGridStarts), progress);
  }
  RefinedFit refined{fit.extended() ? WithVariant(fit, polish.variant, polish.best.p) : fit};
  PreparedFit& prepared = refined.prepared;
  if (!fit.extended() || options.starts != StartsFrom::kShape) {
    refined.best_candidate = polish.first.p;
  }
  refined.report = std::move(polish.report);
  refined.variants = std::move(polish.variants);
  refined.ends = std::move(polish.ends);
  refined.end = std::move(polish.best);
  if (options.loss != Loss::kSquared) {
    WeightedEnd robust = Robustify(options, progress.stop(), {prepared.problem, refined.end});
    prepared.problem = std::move(robust.problem);
    refined.end = std::move(robust.end);
  }
  refined.problem = prepared.problem;
  WeighReadings(progress, &refined);
  OrderAlike(prepared.device, prepared.bounds, &refined.end.p, &refined.end.active);
  for (FitPoint& other : refined.ends) {
    OrderAlike(prepared.device, prepared.bounds, &other.p, nullptr);
  }
  return refined;
}

}  // namespace lyrefit
