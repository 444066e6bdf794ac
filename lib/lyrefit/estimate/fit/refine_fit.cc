#include "lyrefit/estimate/fit/refine_fit.h"

#include <utility>

#include "lyrefit/base/seconds.h"
#include "lyrefit/estimate/fit/error_degrees.h"
#include "lyrefit/estimate/fit/intervals.h"
#include "lyrefit/estimate/fit/order_alike.h"
#include "lyrefit/estimate/fit/polish_extended.h"
#include "lyrefit/estimate/fit/robust.h"
#include "lyrefit/estimate/fit/variant_problem.h"
#include "lyrefit/estimate/fit/weigh.h"

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

void WeighReadings(const ProgressReporter& progress, RefinedFit* fit) {
  const PreparedFit& prepared = fit->prepared;
  const ErrorSpec& spec = prepared.options.errors;
  if (spec.kind == ErrorKind::kWhite) return;
  const RmsePair least_squares = BothRmse(prepared.device, fit->end.p, prepared.curve);
  const std::optional<WeighedFit> weighed =
      WeighAndRefine(spec, prepared.fitted(), progress, &fit->problem, &fit->end);
  if (!weighed) return;
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
    Robustify(options, progress.stop(), &prepared.problem, &refined.end);
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
