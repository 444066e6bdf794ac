#include "lyrefit/estimate/fit/estimate_parameters.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/seconds.h"
#include "lyrefit/base/version.h"
#include "lyrefit/estimate/fit/statistics.h"

namespace lyrefit {
namespace {

constexpr double kSameEnd = 1e-9;       // relative difference of mean squares in one optimum
constexpr double kNearBest = 1.5;       // mean square of an end that may lie inside the intervals
constexpr std::size_t kMostOthers = 4;  // of such ends
constexpr int kMostRounds = 12;         // of settling the weights
constexpr double kOfRounding = 1e-11;   // rms of the largest current: residuals are rounding
constexpr double kFirstTrustRadius = 1e4;  // of the steps of an early stage

struct Descent : MultistartEnd {
  RefineEnd end;
  std::string origin;
  double start_mean_square = HUGE_VAL;
};

bool IsSameEnd(const MultistartEnd& a, const MultistartEnd& b) {
  return std::isfinite(a.value) &&
         std::fabs(a.value - b.value) <= kSameEnd * std::max(a.value, b.value);
}

// One solve of a last stage; few steps of an early one.
RefineOptions StepsOf(const MultistartStage& stage, const StopToken& stop) {
  RefineOptions how;
  how.stop = stop;
  if (stage.steps == 0) return how;
  how.small = true;
  how.max_rounds = 0;
  how.first_iterations = stage.steps;
  how.trust_radius = kFirstTrustRadius;
  return how;
}

Multistart<Descent> RunDescents(const EstimateProblem& problem,
                                const std::vector<EstimateStart>& starts, int threads,
                                const StopToken& stop) {
  const auto refine = [&](const MultistartStage& stage, Descent* at) {
    if (!std::isfinite(at->start_mean_square)) {
      at->start_mean_square = problem.model.MeanSquare(at->end);
    }
    at->end = RefineModel(problem.model, at->end, StepsOf(stage, stop));
    at->value = at->end.mean_square;
  };
  MultistartRules rules = problem.polish;
  rules.threads = threads;
  std::vector<Descent> descents(starts.size());
  for (std::size_t k = 0; k < starts.size(); ++k) {
    descents[k].end.p = starts[k].p;
    descents[k].origin = starts[k].origin;
  }
  Multistart<Descent> run;
  RunMultistart(rules, std::move(descents), refine, IsSameEnd, &run);
  return run;
}

RefineReport CourseOf(const Multistart<Descent>& run, bool stopped) {
  RefineReport course;
  for (std::size_t k = 0; k < run.ends.size(); ++k) {
    const Descent& descent = run.ends[k];
    if (!descent.finished) continue;
    if (static_cast<int>(k) == run.best) course.winner = static_cast<int>(course.starts.size());
    const bool agrees = IsSameEnd(descent, run.Best());
    course.agreeing += agrees ? 1 : 0;
    course.starts.push_back(
        {descent.origin, std::sqrt(descent.start_mean_square), std::sqrt(descent.value), agrees});
  }
  const bool converged = run.best >= 0 && run.Best().end.converged;
  course.termination = stopped ? "interrupted" : converged ? "converged" : "no convergence";
  return course;
}

// Distinct ends beside the best one, the best first, after those that the problem names.
std::vector<FitPoint> OthersOf(const EstimateProblem& problem, const Multistart<Descent>& run,
                               const StopToken& stop) {
  std::vector<FitPoint> points;
  if (!problem.several_optima) return points;
  if (problem.more_optima) points = problem.more_optima(run.Best().end, stop);
  std::vector<const Descent*> others;
  for (const Descent& descent : run.ends) {
    const bool near = descent.value < kNearBest * run.Best().value;
    if (near && !IsSameEnd(descent, run.Best())) others.push_back(&descent);
  }
  std::stable_sort(others.begin(), others.end(),
                   [](const Descent* a, const Descent* b) { return a->value < b->value; });
  for (const Descent* descent : others) {
    if (points.size() < kMostOthers) points.push_back(descent->end);
  }
  return points;
}

EstimateErrors ErrorsAt(const EstimateProblem& problem, const RefineEnd& end) {
  if (problem.errors) return problem.errors(end);
  const int degrees = DegreesOfFreedom(problem);
  const double variance = end.mean_square * problem.readings / degrees;
  return {variance, degrees, FindSpread(problem.model, end, end.active, variance)};
}

IntervalStep LastStepOf(Intervals wanted, const EstimateProblem& problem, const RefineEnd& end) {
  if (wanted == Intervals::kNone) return IntervalStep::kErrors;
  // A profile compares sums of squares with their own size: of rounding that says nothing.
  const double unit = problem.model.shape().current_scale_A;
  const bool rounding = !problem.errors && std::sqrt(end.mean_square) < kOfRounding * unit;
  return wanted == Intervals::kProfile && !rounding ? IntervalStep::kProfile
                                                    : IntervalStep::kSymmetric;
}

int FreeParameters(const EstimateProblem& problem) {
  return static_cast<int>(std::count_if(problem.parameters.begin(), problem.parameters.end(),
                                        [](const Estimate& e) { return !e.fixed; }));
}

// The profiles around one end.
struct Profiles {
  const EstimateProblem& problem;
  const RefineEnd& best;
  std::vector<FitPoint> others = {};  // optima inside the intervals
  double highest = 0;                 // mean square at the ends of the intervals
  StopToken stop = {};

  ProfileSide Find(ProfileQuery query) const {
    query.local_optima = others;
    RefineOptions how = problem.refits;
    how.stop = stop;
    if (!problem.refit) return FindProfileSide(problem.model, best, query, how);
    const auto refit = [&](double value, const FitPoint& start, double target, double tolerance) {
      ProfileRefit at{best, highest, query.parameter, value, how};
      at.how.target = target;
      at.how.function_tolerance = tolerance;
      return problem.refit(at, start);
    };
    return FindProfileSide(problem.model, best, query, {refit, nullptr});
  }
};

IntervalReport IntervalsAt(const EstimateProblem& problem, const RefineEnd& end,
                           const std::vector<FitPoint>& others, const std::vector<double>& searched,
                           const EstimateOptions& options, const ProgressReporter& progress) {
  EstimateErrors errors = ErrorsAt(problem, end);
  IntervalProblem intervals;
  intervals.estimates = WithValues(problem.parameters, searched, end.p);
  intervals.effects = problem.effects;
  intervals.further = problem.further;
  intervals.active = end.active;
  intervals.rules = problem.intervals;
  intervals.threads = options.threads;
  intervals.last = LastStepOf(options.intervals, problem, end);
  intervals.spread = std::move(errors.spread);
  intervals.stretch = std::move(errors.stretch);
  intervals.variance = errors.variance;
  const double t = StudentT95(errors.degrees);
  intervals.t.assign(intervals.estimates.size(), t);
  intervals.several_optima = problem.several_optima;
  Profiles profiles{problem, end};
  profiles.stop = progress.stop();
  profiles.highest = end.mean_square + t * t * errors.variance / problem.model.shape().points;
  for (const FitPoint& other : others) {
    if (problem.model.MeanSquare(other) < profiles.highest) profiles.others.push_back(other);
  }
  intervals.profile = [&profiles](const ProfileQuery& query) { return profiles.Find(query); };
  return FindIntervals(std::move(intervals), progress);
}

// The lowest of the refits of profiles that ended below the optimum.
std::vector<double> LowestOf(const FitModel& model, const IntervalReport& found) {
  const auto lowest =
      std::min_element(found.better.begin(), found.better.end(), [&](const auto& a, const auto& b) {
        return model.MeanSquare({a, {}}) < model.MeanSquare({b, {}});
      });
  return lowest == found.better.end() ? std::vector<double>() : *lowest;
}

RmsePair RmseOf(const EstimateProblem& problem, double mean_square) {
  RmsePair rmse;
  if (!problem.objective) return rmse;
  const bool solved = *problem.objective == Objective::kSolvedCurrent;
  (solved ? rmse.solved_current_A : rmse.measured_current_A) = std::sqrt(mean_square);
  return rmse;
}

// The search's report, and its elites as starts.
struct SearchedParameters {
  SearchSummary summary;
  std::vector<EstimateStart> elites;
};

SearchedParameters SearchParameters(const EstimateProblem& problem, const EstimateOptions& options,
                                    const Observer& observer) {
  SearchedParameters searched;
  if (!problem.parameters_at) return searched;
  const ObjectiveFunction objective = [&problem](const double* x) {
    return std::sqrt(problem.model.MeanSquare({problem.parameters_at(x), {}}));
  };
  searched.summary = Search(objective, problem.box, options.search, observer);
  for (const Candidate& elite : searched.summary.elites) {
    const std::size_t rank = searched.elites.size() + 1;
    searched.elites.push_back({rank == 1 ? "best candidate" : fmt::format("elite {}", rank),
                               problem.parameters_at(elite.x.data())});
  }
  return searched;
}

}  // namespace

int DegreesOfFreedom(const EstimateProblem& problem) {
  return std::max(problem.readings - FreeParameters(problem), 1);
}

PolishedParameters PolishParameters(const EstimateProblem& problem,
                                    std::vector<EstimateStart> starts,
                                    const EstimateOptions& options,
                                    const ProgressReporter& progress) {
  PolishedParameters polished;
  const StopToken& stop = progress.stop();
  const Instant begin = Now();
  for (int round = 0; round < kMostRounds && !starts.empty(); ++round) {
    const Multistart<Descent> run = RunDescents(problem, starts, options.threads, stop);
    polished.course = CourseOf(run, stop.requested());
    if (run.best < 0) break;
    polished.best = run.Best().end;
    const bool last = !problem.settle || stop.requested() || !problem.settle(polished.best);
    if (last) polished.others = OthersOf(problem, run, stop);
    if (last) break;
    if (round > 0) starts.clear();
    starts.insert(starts.begin(), {"the weights before", polished.best.p});
  }
  polished.course.seconds = SecondsSince(begin);
  return polished;
}

EstimatedParameters JudgeParameters(const EstimateProblem& problem,
                                    const PolishedParameters& polished,
                                    const std::vector<double>& searched,
                                    const EstimateOptions& options,
                                    const ProgressReporter& progress) {
  const Instant begin = Now();
  EstimateReport report;
  report.version = Version();
  report.search_options = options.search;
  report.refine = polished.course;
  if (problem.why_not_usable) report.not_usable_because = problem.why_not_usable(polished.best);
  report.usable = report.not_usable_because.empty();
  // Around parameters of readings that the model does not describe no interval means anything.
  EstimateOptions judging = options;
  if (!report.usable) judging.intervals = Intervals::kNone;
  const StopToken& stop = progress.stop();
  auto improved = ImproveByIntervals(
      polished.best, problem.restarts,
      [&](const RefineEnd& end, bool /*final*/) {
        return IntervalsAt(problem, end, polished.others, searched, judging, progress);
      },
      [&](const IntervalReport& found) {
        return stop.requested() ? std::vector<double>() : LowestOf(problem.model, found);
      },
      [&](const std::vector<double>& p) {
        return RefineModel(problem.model, {p, {}}, StepsOf({}, stop));
      });
  report.interval_seconds = SecondsSince(begin);
  report.estimates = std::move(improved.found.estimates);
  report.correlations = std::move(improved.found.correlations);
  const RefineEnd& end = improved.end;
  report.refine.condition = improved.found.condition;
  report.refine.projected_gradient = end.projected_gradient;
  if (!stop.requested()) {
    report.refine.termination = end.converged ? "converged" : "no convergence";
  }
  report.rmse.refined = RmseOf(problem, end.mean_square);
  if (problem.readings > 0) {
    report.criteria = FindInformation(end.mean_square, problem.readings, FreeParameters(problem));
  }
  report.interrupted = stop.requested();
  return {std::move(improved.end), std::move(report)};
}

EstimatedParameters EstimateParameters(const EstimateProblem& problem,
                                       const EstimateOptions& options, const Observer& observer) {
  CHECK(problem.parameters_at || !problem.starts.empty())
      << "a problem without a box to search needs a start";
  const ProgressReporter progress(observer);
  SearchedParameters searched = SearchParameters(problem, options, observer);
  if (searched.summary.termination == SearchTermination::kInterrupted) progress.stop().Request();
  std::vector<double> candidate;
  if (!searched.elites.empty()) candidate = searched.elites.front().p;
  progress.Begin("polish", 0);
  std::vector<EstimateStart> starts = std::move(searched.elites);
  starts.insert(starts.end(), problem.starts.begin(), problem.starts.end());
  const PolishedParameters polished =
      PolishParameters(problem, std::move(starts), options, progress);
  progress.Begin("intervals", 0);
  EstimatedParameters found = JudgeParameters(problem, polished, candidate, options, progress);
  found.report.curve_evaluations = searched.summary.evaluations;
  found.report.search = std::move(searched.summary);
  if (!candidate.empty()) {
    found.report.rmse.searched = RmseOf(problem, problem.model.MeanSquare({candidate, {}}));
  }
  return found;
}

}  // namespace lyrefit
