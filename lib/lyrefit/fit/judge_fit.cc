#include "lyrefit/fit/judge_fit.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lyrefit/fit/error_degrees.h"
#include "lyrefit/fit/intervals.h"
#include "lyrefit/fit/order_alike.h"
#include "lyrefit/fit/weigh.h"

namespace lyrefit {
namespace {

// Records the restart from `better` as the end of the polish.
void StartOver(const RefineProblem& problem, const RefineEnd& end,
               const std::vector<double>& better, RefineReport* report) {
  for (StartReport& start : report->starts) start.agrees = false;
  report->starts.push_back(
      {"profile", std::sqrt(MeanSquare(problem, better)), std::sqrt(end.mean_square), true});
  report->winner = static_cast<int>(report->starts.size()) - 1;
  report->agreeing = 1;
}

int SpareReadings(const FitJob& job) { return std::max(job.readings() - job.free_parameters, 1); }

}  // namespace

void JudgeAndImprove(FitJob* job, const RefineProblem& problem, const std::vector<FitPoint>& ends,
                     const std::vector<int>& degrees, RefineEnd* end, FitReport* report) {
  const FitOptions& options = job->options;
  const bool wanted = report->no_intervals_because.empty();
  // With many correlated readings that are not averaged, profiles would take minutes.
  constexpr std::size_t kMostProfiled = 2000;
  const bool many = problem.errors != nullptr && problem.voltage_V.size() > kMostProfiled;
  const Intervals method =
      many && options.intervals == Intervals::kProfile ? Intervals::kSymmetric : options.intervals;
  constexpr int kRestarts = 3;
  for (int round = 0; round <= kRestarts; ++round) {
    OrderAlike(report->device, job->bounds, &end->p, &end->held);
    report->refined = end->p;
    report->estimates = EstimatesOf(*job, *report);
    report->correlations.clear();
    const IntervalInput input{problem,
                              *end,
                              ends,
                              wanted ? method : Intervals::kNone,
                              job->free_parameters,
                              job->readings(),
                              options.threads,
                              job->progress,
                              round == kRestarts,
                              nullptr,
                              degrees};
    const std::vector<double> better =
        FindIntervals(input, &report->estimates, &report->correlations, &report->refine.condition);
    if (better.empty() || round == kRestarts) break;
    RefineOptions how;
    how.stop = job->progress.stop();
    *end = Refine(problem, better, how);
    StartOver(problem, *end, better, &report->refine);
  }
}

void FindIntervalsUnderErrors(FitJob* job, const std::vector<FitPoint>& ends, const RefineEnd& end,
                              FitReport* report) {
  const bool possible = job->options.loss == Loss::kSquared && report->no_intervals_because.empty();
  if (job->options.intervals == Intervals::kNone || !possible || job->progress.stop().requested())
    return;
  const std::optional<FoundErrors> found = FindErrors(job->problem, job->fitted(), end);
  if (!found) return;
  ErrorReport errors;
  errors.sizes = found->sizes;
  errors.gain = found->gain;
  errors.current_stated = !job->fitted().sigma_A.empty();
  errors.believed = found->gain > kGainToBelieve;
  report->errors = errors;
  if (!errors.believed) return;
  const ErrorShape shape = ShapeOfErrors(job->problem, job->fitted(), end.p);
  const auto input_under = [&](const ErrorModel& model) {
    return IntervalInput{job->problem,
                         end,
                         ends,
                         job->options.intervals,
                         job->free_parameters,
                         job->readings(),
                         job->options.threads,
                         job->progress,
                         true,
                         &model};
  };
  const auto errors_at = [&](const ErrorSizes& sizes) {
    return StandardErrors(input_under(MakeErrorModel(shape, sizes)));
  };
  const ErrorModel model = MakeErrorModel(shape, found->sizes);
  IntervalInput input = input_under(model);
  input.degrees = FindDegrees(*found, errors_at, SpareReadings(*job));
  report->under_errors = EstimatesOf(*job, *report);
  std::vector<Correlation> correlations;
  double condition = 0;
  FindIntervals(input, &report->under_errors, &correlations, &condition);
}

std::vector<int> DegreesOfWeighed(FitJob* job, const FoundErrors& found, const RefineEnd& end) {
  const auto errors_at = [&](const ErrorSizes& sizes) {
    const ErrorSpec spec = {ErrorKind::kField, sizes, "field"};
    const RefineProblem there = WeighByErrors(job->problem, job->fitted(), spec, end.p);
    return StandardErrors({there,
                           end,
                           {},
                           Intervals::kSymmetric,
                           job->free_parameters,
                           job->readings(),
                           job->options.threads,
                           job->progress});
  };
  return FindDegrees(found, errors_at, SpareReadings(*job));
}

}  // namespace lyrefit
