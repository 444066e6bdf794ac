#include "lyrefit/estimate/fit/judge_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/estimate/fit/error_degrees.h"
#include "lyrefit/estimate/fit/order_alike.h"
#include "lyrefit/estimate/fit/reading_errors.h"

namespace lyrefit {
namespace {

std::string TooFewReadings(const PreparedFit& fit) {
  return fmt::format("{} different readings fix {} parameters without a remainder", fit.readings(),
                     fit.free_parameters);
}

bool IsSaturated(const PreparedFit& fit) { return fit.readings() <= fit.free_parameters; }

// Also finds bounds that are refuted.
std::string WhyNoIntervals(const RefinedFit& refined, bool usable, const ProgressReporter& progress,
                           RefutedBounds* refuted) {
  const PreparedFit& fit = refined.prepared;
  if (fit.options.intervals == Intervals::kNone) return "";
  if (!usable) {
    return "the fit is not usable: around parameters of a curve that the model does not describe "
           "no "
           "interval means anything";
  }
  if (IsSaturated(fit)) return TooFewReadings(fit) + ", and nothing is left over to tell how well";
  *refuted = FindRefutedBounds(refined, progress);
  return refuted->because;
}

// Method of the intervals. With many correlated readings that are not averaged, profiles would take
// minutes.
Intervals MethodOf(const RefinedFit& refined) {
  constexpr std::size_t kMostProfiled = 2000;
  const Intervals wanted = refined.prepared.options.intervals;
  const bool many =
      refined.problem.errors != nullptr && refined.problem.voltage_V.size() > kMostProfiled;
  return many && wanted == Intervals::kProfile ? Intervals::kSymmetric : wanted;
}

void FindIntervalsAndImprove(const RefinedFit& refined, const std::vector<double>& searched,
                             const ProgressReporter& progress, JudgedFit* judged) {
  const PreparedFit& fit = refined.prepared;
  const Intervals method =
      judged->no_intervals_because.empty() ? MethodOf(refined) : Intervals::kNone;
  constexpr int kRestarts = 3;
  for (int round = 0; round <= kRestarts; ++round) {
    OrderAlike(fit.device, fit.bounds, &judged->end.p, &judged->end.active);
    CurveIntervals found = FindIntervals(
        {refined.problem, judged->end, fit.spare_readings()},
        EstimatesOf(fit, searched, judged->end.p),
        {method, refined.ends, refined.degrees, fit.options.threads, /*final=*/round == kRestarts},
        progress);
    judged->estimates = std::move(found.estimates);
    judged->correlations = std::move(found.correlations);
    judged->covariance = std::move(found.covariance);
    judged->condition = found.condition;
    const std::vector<double>& better = found.lower_optimum;
    if (better.empty() || round == kRestarts) break;
    RefineOptions how;
    how.stop = progress.stop();
    judged->end = Refine(refined.problem, better, how);
    judged->restarts.push_back({"profile", std::sqrt(MeanSquare(refined.problem, better)),
                                std::sqrt(judged->end.mean_square), true});
  }
}

double LargestRatio(const std::vector<double>& above, const std::vector<double>& below) {
  double largest = 0;
  for (std::size_t k = 0; k < above.size(); ++k) largest = std::max(largest, above[k] / below[k]);
  return largest;
}

// Estimates the errors of a least-squares fit, and finds intervals under them if they are believed
// (kGainToBelieve).
void FindIntervalsUnderErrors(const RefinedFit& refined, const std::vector<double>& searched,
                              const ProgressReporter& progress, JudgedFit* judged) {
  const PreparedFit& fit = refined.prepared;
  const bool possible = fit.options.loss == Loss::kSquared && judged->no_intervals_because.empty();
  const bool wanted = fit.options.find_errors && fit.options.intervals != Intervals::kNone;
  if (refined.errors || !wanted || !possible || progress.stop().requested()) return;
  const RefineEnd& end = judged->end;
  const std::optional<FoundErrors> found = FindErrors(fit.problem, fit.fitted(), end, false);
  if (!found) return;
  ErrorReport errors;
  errors.sizes = found->sizes;
  errors.gain = found->gain;
  errors.path_gain = found->path_gain;
  errors.current_stated = !fit.fitted().sigma_A.empty();
  errors.believed = found->gain > kGainToBelieve;
  const ErrorShape shape = ShapeOfErrors(fit.problem, fit.fitted(), end.p);
  errors.voltage_effect_A = found->sizes.voltage_V * LargestRatio(shape.voltage, shape.current);
  errors.part_effect_A = found->sizes.current_part * LargestRatio(shape.part, shape.current);
  judged->errors = errors;
  if (!errors.believed) return;
  const auto errors_at = [&](const ErrorSizes& sizes) {
    const ErrorModel model = MakeErrorModel(shape, sizes);
    return StandardErrors({fit.problem, end, fit.spare_readings(), &model});
  };
  const ErrorModel model = MakeErrorModel(shape, found->sizes);
  CurveIntervals under = FindIntervals(
      {fit.problem, end, fit.spare_readings(), &model}, EstimatesOf(fit, searched, end.p),
      {fit.options.intervals, refined.ends, FindDegrees(*found, errors_at, fit.spare_readings()),
       fit.options.threads,
       /*final=*/true},
      progress);
  judged->under_errors = std::move(under.estimates);
  judged->covariance = std::move(under.covariance);
}

}  // namespace

JudgedFit JudgeFit(const RefinedFit& refined, const std::vector<double>& searched, bool usable,
                   const ProgressReporter& progress) {
  JudgedFit judged;
  judged.end = refined.end;
  judged.errors = refined.errors;
  judged.no_intervals_because = WhyNoIntervals(refined, usable, progress, &judged.refuted);
  FindIntervalsAndImprove(refined, searched, progress, &judged);
  if (IsSaturated(refined.prepared)) {
    for (Estimate& e : judged.estimates) {
      if (e.fixed) continue;
      e.identifiable = false;
      e.reason = TooFewReadings(refined.prepared);
    }
  }
  FindIntervalsUnderErrors(refined, searched, progress, &judged);
  return judged;
}

}  // namespace lyrefit
