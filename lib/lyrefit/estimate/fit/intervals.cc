#include "lyrefit/estimate/fit/intervals.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/estimate/fit/statistics.h"
#include "lyrefit/estimate/refine/coarsen.h"
#include "lyrefit/estimate/refine/other_optima.h"
#include "lyrefit/estimate/refine/profile.h"
#include "lyrefit/estimate/refine/reporting_model.h"
#include "lyrefit/model/reporting_units.h"

namespace lyrefit {
namespace {

constexpr IntervalRules kRules = {
    /*thorough=*/true, /*judge_open_ends=*/true, /*judge_absent_diodes=*/true,
    "no shunt is visible: only a lower limit is known",
    "the data do not fix it: another parameter takes its place exactly"};

// Variance of a residual of weight 1. The spare readings are those of the whole curve, also on
// coarsened data.
double VarianceOf(int spare_readings, const RefineProblem& problem, const RefineEnd& end) {
  if (problem.errors != nullptr) return problem.noise_A * problem.noise_A;  // of the error model
  return end.mean_square * static_cast<double>(problem.voltage_V.size()) / spare_readings;
}

Spread SpreadOf(const CurveEnd& fit, std::vector<bool> active) {
  const EffectSpan effects = SpanOf(fit.problem.device);
  const CurveModel internal(fit.problem);
  const ReportingModel model(internal, effects);
  const FitPoint at = {Reported(effects, fit.end.p), {}};
  const std::vector<bool> flat = FindFlatSettings(model, effects, at);
  for (std::size_t i = 0; i < active.size(); ++i) active[i] = active[i] || flat[i];
  if (fit.errors == nullptr) {
    return FindSpread(model, at, active, VarianceOf(fit.spare_readings, fit.problem, fit.end));
  }
  return FindSpread(model, at, active,
                    [&](const RowMatrix& rows) { return CovarianceTimes(*fit.errors, rows); });
}

// Ratio of the standard errors under `errors` to those of the fit itself. The parameters at bounds
// are freed for it.
std::vector<double> FindStretch(const CurveEnd& fit, const std::vector<Estimate>& estimates) {
  if (fit.errors == nullptr) return {};
  std::vector<bool> fixed;
  fixed.reserve(estimates.size());
  for (const Estimate& e : estimates) fixed.push_back(!e.free());
  CurveEnd plain = fit;
  plain.errors = nullptr;
  return StretchOf(SpreadOf(fit, fixed).standard_error, SpreadOf(plain, fixed).standard_error);
}

// A profile compares sums of squares, which has no meaning if the residuals are only rounding.
bool ResidualsAreNoise(const CurveEnd& fit) {
  return std::sqrt(fit.end.mean_square) > 1e-11 * fit.problem.current_scale_A;
}

// Other optima of a device with effects whose sum of squares rises by less than reach^2 variances,
// in internal units.
std::vector<FitPoint> FindMoreOptima(const CurveEnd& fit, const std::vector<FitPoint>& ends,
                                     double reach, const StopToken& stop) {
  const EffectSpan effects = SpanOf(fit.problem.device);
  if (effects.effects == nullptr) return {};
  const double rise = reach * reach * VarianceOf(fit.spare_readings, fit.problem, fit.end) /
                      static_cast<double>(fit.problem.voltage_V.size());
  OptimumQuery query{fit.end.mean_square + rise, ProfileOptions(stop)};
  query.how.cutoff = query.highest;
  return FindOtherOptima(CurveModel(fit.problem), effects, fit.end, ends, query);
}

// The profiles of one curve, on coarsened data.
class CurveProfiles {
 public:
  CurveProfiles(const CurveEnd& fit, std::vector<FitPoint> local_optima, StopToken stop)
      : fit_(fit),
        stop_(std::move(stop)),
        problem_(Coarsen(fit.problem)),
        coarsened_(problem_.points.size < fit.problem.points.size),
        end_(coarsened_ ? Refine(problem_, fit.end.p, Options()) : fit.end),
        effects_(SpanOf(problem_.device)),
        internal_(problem_),
        model_(internal_, effects_),
        reported_(end_),
        local_optima_(std::move(local_optima)),
        reported_optima_(local_optima_) {
    reported_.p = Reported(effects_, end_.p);
    for (FitPoint& other : reported_optima_) other.p = Reported(effects_, other.p);
  }
  CurveProfiles(const CurveProfiles&) = delete;
  CurveProfiles& operator=(const CurveProfiles&) = delete;

  bool coarsened() const { return coarsened_; }
  double variance() const { return VarianceOf(fit_.spare_readings, problem_, end_); }
  bool several_optima() const { return !local_optima_.empty(); }

  // `better` of the result is in internal units.
  ProfileSide Find(ProfileQuery query) const {
    if (!effects_.Has(query.parameter)) {
      query.local_optima = local_optima_;
      return FindProfileSide(problem_, end_, query, stop_);
    }
    query.local_optima = reported_optima_;
    ProfileSide side = FindProfileSide(model_, reported_, query, ProfileOptions(stop_));
    side.better = Internal(effects_, std::move(side.better));
    return side;
  }

  // The lowest of these ends of refits and the local optima, if it is below the end of the fit;
  // empty: none is. An end that is lower on coarsened data counts only if it is lower on all
  // points.
  std::vector<double> FindLower(const std::vector<std::vector<double>>& refits) const {
    constexpr double kLower = 1e-7;  // relative
    std::vector<double> lower;
    double lowest = fit_.end.mean_square * (1 - kLower);
    const auto take_if_lower = [&](const std::vector<double>& p, bool refine) {
      const std::vector<double> there = refine ? Refine(fit_.problem, p, Options()).p : p;
      const double mean_square = MeanSquare(fit_.problem, there);
      if (!(mean_square < lowest)) return;
      lowest = mean_square;
      lower = there;
    };
    for (const FitPoint& other : local_optima_) take_if_lower(other.p, /*refine=*/true);
    for (const std::vector<double>& p : refits) take_if_lower(p, coarsened_);
    return lower;
  }

 private:
  RefineOptions Options() const {
    RefineOptions how;
    how.stop = stop_;
    return how;
  }

  const CurveEnd& fit_;
  const StopToken stop_;
  const RefineProblem problem_;
  const bool coarsened_;
  const RefineEnd end_;
  const EffectSpan effects_;
  const CurveModel internal_;
  const ReportingModel model_;
  RefineEnd reported_;  // `end_` in reporting units
  const std::vector<FitPoint> local_optima_;
  std::vector<FitPoint> reported_optima_;
};

IntervalStep LastStep(Intervals method, const CurveEnd& fit) {
  if (method == Intervals::kNone) return IntervalStep::kBounds;
  return method == Intervals::kProfile && ResidualsAreNoise(fit) ? IntervalStep::kProfile
                                                                 : IntervalStep::kSymmetric;
}

// The covariance behind symmetric intervals, NaN for parameters without a standard error.
FitCovariance CovarianceOf(const IntervalProblem& problem) {
  FitCovariance found;
  const std::size_t size = problem.estimates.size();
  const std::vector<double>& error = problem.spread.standard_error;
  found.values.assign(size, std::vector<double>(size, kUnknown));
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < size; ++j) {
      if (!std::isfinite(error[i]) || !std::isfinite(error[j])) continue;
      found.values[i][j] = problem.spread.covariance(static_cast<int>(i), static_cast<int>(j));
    }
  }
  found.t_95 = *std::max_element(problem.t.begin(), problem.t.end());
  return found;
}

double LargestReach(const IntervalProblem& problem) {
  double reach = 0;
  for (std::size_t i = 0; i < problem.t.size(); ++i) {
    reach = std::max(reach, problem.t[i] * (problem.stretch.empty() ? 1 : problem.stretch[i]));
  }
  return reach;
}

}  // namespace

std::vector<double> StandardErrors(const CurveEnd& fit) {
  return SpreadOf(fit, fit.end.active).standard_error;
}

CurveIntervals FindIntervals(const CurveEnd& fit, std::vector<Estimate> estimates,
                             const CurveIntervalOptions& options,
                             const ProgressReporter& progress) {
  IntervalProblem problem;
  problem.estimates = std::move(estimates);
  // A setting may end at a bound without an active bound there.
  problem.active.reserve(problem.estimates.size());
  for (const Estimate& e : problem.estimates) {
    problem.active.push_back(fit.end.active[problem.active.size()] || e.refined <= e.bounds.lower ||
                             e.refined >= e.bounds.upper);
  }
  problem.effects = SpanOf(fit.problem.device);
  problem.last = LastStep(options.method, fit);
  problem.rules = kRules;
  problem.threads = options.threads;
  if (problem.last == IntervalStep::kBounds) return {FindIntervals(std::move(problem), progress)};
  problem.spread = SpreadOf(fit, fit.end.active);
  problem.t.reserve(problem.estimates.size());
  for (std::size_t i = 0; i < problem.estimates.size(); ++i) {
    problem.t.push_back(
        StudentT95(options.degrees.empty() ? fit.spare_readings : options.degrees[i]));
  }
  FitCovariance covariance = CovarianceOf(problem);
  if (problem.last == IntervalStep::kSymmetric) {
    return {FindIntervals(std::move(problem), progress), {}, std::move(covariance)};
  }
  problem.stretch = FindStretch(fit, problem.estimates);
  const StopToken& stop = progress.stop();
  const CurveProfiles profiles(fit, FindMoreOptima(fit, options.ends, LargestReach(problem), stop),
                               stop);
  problem.variance = profiles.variance();
  problem.several_optima = profiles.several_optima();
  problem.end_at_better = !options.final && !profiles.coarsened();
  problem.profile = [&](const ProfileQuery& query) { return profiles.Find(query); };
  CurveIntervals found = {FindIntervals(std::move(problem), progress)};
  found.lower_optimum = profiles.FindLower(found.better);
  found.covariance = std::move(covariance);
  return found;
}

}  // namespace lyrefit
