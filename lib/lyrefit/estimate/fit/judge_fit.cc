#include "lyrefit/estimate/fit/judge_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/estimate/fit/error_degrees.h"
#include "lyrefit/estimate/fit/estimate_parameters.h"
#include "lyrefit/estimate/fit/order_alike.h"
#include "lyrefit/estimate/fit/reading_errors.h"

namespace lyrefit {
namespace {

std::string TooFewReadings(const PreparedFit& fit) {
  return fmt::format("{} different readings fix {} parameters without a remainder", fit.readings(),
                     fit.free_parameters);
}

bool IsSaturated(const PreparedFit& fit) { return fit.readings() <= fit.free_parameters; }

// Why there are no intervals; with wider bounds if those of the fit are refuted.
RefutedBounds WhyNoIntervals(const RefinedFit& refined, bool usable,
                             const ProgressReporter& progress) {
  const PreparedFit& fit = refined.prepared;
  if (fit.options.intervals == Intervals::kNone) return {};
  if (!usable) {
    return {
        "the fit is not usable: around parameters of a curve that the model does not describe "
        "no interval means anything",
        {},
        {}};
  }
  if (IsSaturated(fit)) {
    return {TooFewReadings(fit) + ", and nothing is left over to tell how well", {}, {}};
  }
  return FindRefutedBounds(refined, progress);
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

JudgedFit WithIntervals(JudgedFit judged, const RefinedFit& refined,
                        const std::vector<double>& searched, const ProgressReporter& progress) {
  const PreparedFit& fit = refined.prepared;
  const Intervals method =
      judged.no_intervals_because.empty() ? MethodOf(refined) : Intervals::kNone;
  const auto ordered = [&](RefineEnd end) {
    OrderAlike(fit.device, fit.bounds, &end.p, &end.active);
    return end;
  };
  auto improved = ImproveByIntervals(
      ordered(refined.end), /*restarts=*/3,
      [&](const RefineEnd& end, bool final) {
        return FindIntervals(
            {refined.problem, end, fit.spare_readings()}, EstimatesOf(fit, searched, end.p),
            {method, refined.ends, refined.degrees, fit.options.threads, final}, progress);
      },
      [](const CurveIntervals& found) { return found.lower_optimum; },
      [&](const std::vector<double>& from) {
        RefineOptions how;
        how.stop = progress.stop();
        RefineEnd end = Refine(refined.problem, from, how);
        judged.restarts.push_back({"profile", std::sqrt(MeanSquare(refined.problem, from)),
                                   std::sqrt(end.mean_square), true});
        return ordered(std::move(end));
      });
  judged.end = std::move(improved.end);
  judged.estimates = std::move(improved.found.estimates);
  judged.correlations = std::move(improved.found.correlations);
  judged.covariance = std::move(improved.found.covariance);
  judged.condition = improved.found.condition;
  return judged;
}

double LargestRatio(const std::vector<double>& above, const std::vector<double>& below) {
  double largest = 0;
  for (std::size_t k = 0; k < above.size(); ++k) largest = std::max(largest, above[k] / below[k]);
  return largest;
}

// Estimates the errors of a least-squares fit, and finds intervals under them if they are believed
// (kGainToBelieve).
JudgedFit WithErrors(JudgedFit judged, const RefinedFit& refined,
                     const std::vector<double>& searched, const ProgressReporter& progress) {
  const PreparedFit& fit = refined.prepared;
  const bool possible = fit.options.loss == Loss::kSquared && judged.no_intervals_because.empty();
  const bool wanted = fit.options.find_errors && fit.options.intervals != Intervals::kNone;
  if (refined.errors || !wanted || !possible || progress.stop().requested()) return judged;
  const RefineEnd& end = judged.end;
  const std::optional<FoundErrors> found = FindErrors(fit.problem, fit.fitted(), end, false);
  if (!found) return judged;
  ErrorReport errors;
  errors.sizes = found->sizes;
  errors.gain = found->gain;
  errors.path_gain = found->path_gain;
  errors.current_stated = !fit.fitted().sigma_A.empty();
  errors.believed = found->gain > kGainToBelieve;
  const ErrorShape shape = ShapeOfErrors(fit.problem, fit.fitted(), end.p);
  errors.voltage_effect_A = found->sizes.voltage_V * LargestRatio(shape.voltage, shape.current);
  errors.part_effect_A = found->sizes.current_part * LargestRatio(shape.part, shape.current);
  judged.errors = errors;
  if (!errors.believed) return judged;
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
  judged.under_errors = std::move(under.estimates);
  judged.covariance = std::move(under.covariance);
  return judged;
}

}  // namespace

JudgedFit JudgeFit(const RefinedFit& refined, const std::vector<double>& searched, bool usable,
                   const ProgressReporter& progress) {
  JudgedFit judged;
  judged.errors = refined.errors;
  judged.refuted = WhyNoIntervals(refined, usable, progress);
  judged.no_intervals_because = judged.refuted.because;
  judged = WithIntervals(std::move(judged), refined, searched, progress);
  if (IsSaturated(refined.prepared)) {
    for (Estimate& e : judged.estimates) {
      if (e.fixed) continue;
      e.identifiable = false;
      e.reason = TooFewReadings(refined.prepared);
    }
  }
  return WithErrors(std::move(judged), refined, searched, progress);
}

}  // namespace lyrefit
