#include "lyrefit/fit/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "lyrefit/base/seconds.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/fit/check_candidates.h"
#include "lyrefit/fit/descent_starts.h"
#include "lyrefit/fit/fit_job.h"
#include "lyrefit/fit/floor.h"
#include "lyrefit/fit/judge_fit.h"
#include "lyrefit/fit/order_alike.h"
#include "lyrefit/fit/polish.h"
#include "lyrefit/fit/polish_extended.h"
#include "lyrefit/fit/prove_floor.h"
#include "lyrefit/fit/refuted_bound.h"
#include "lyrefit/fit/robust.h"
#include "lyrefit/fit/search_space.h"
#include "lyrefit/fit/statistics.h"
#include "lyrefit/fit/usable.h"
#include "lyrefit/fit/variant_problem.h"
#include "lyrefit/fit/warnings.h"
#include "lyrefit/fit/weigh.h"
#include "lyrefit/law/current.h"
#include "lyrefit/law/model_points.h"
#include "lyrefit/search/search.h"

namespace lyrefit {
namespace {

constexpr int kGridStarts = 4;

// RMSE of the points of the search space on the points of a problem, in the objective of the fit, in
// ampere. Space and problem must outlive the function.
ObjectiveFunction RmseIn(const SearchSpace& space, const RefineProblem& problem) {
  std::vector<double> p(problem.device.size());
  return [&space, &problem, p](const double* x) mutable {
    space.ToParameters(x, p.data());
    return std::sqrt(MeanSquare(problem, p));
  };
}

std::vector<double> DeviceAt(const SearchSpace& space, const FitJob& job, const double* x) {
  std::vector<double> p(job.problem.device.size());
  space.ToParameters(x, p.data());
  return p;
}

// Starts as points of the search space, sorted by rank within their variant: the best of each
// variant first, then the second of each. Costs one evaluation of the objective each.
std::vector<std::vector<double>> Suggestions(const SearchSpace& space, const RefineProblem& problem,
                                             const std::vector<PolishStart>& starts) {
  struct Place {
    const PolishStart* start;
    double mean_square;
    int rank;  // within its variant
  };
  std::vector<Place> places;
  for (const PolishStart& start : starts) {
    places.push_back({&start, MeanSquare(problem, start.p), 0});
    if (!std::isfinite(places.back().mean_square)) places.pop_back();
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.mean_square < b.mean_square; });
  std::map<int, int> of_variant;
  for (Place& place : places) place.rank = of_variant[place.start->variant]++;
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.rank < b.rank; });
  std::vector<std::vector<double>> suggested;
  for (const Place& place : places) {
    suggested.push_back(space.FromParameters(place.start->p.data(), place.start->variant));
  }
  return suggested;
}

// Evaluates as many random points as the search did and reports the best one.
void RunRandomBaseline(FitJob* job, const ObjectiveFunction& objective, const SearchSpace& space,
                       FitReport* report) {
  SearchOptions random = job->options.search;
  random.algorithm = Algorithm::kRandom;
  random.max_evaluations = std::max<std::int64_t>(report->search.evaluations, 4);
  random.target = -kInfinity;
  random.patience = 0;
  const SearchSummary baseline = Search(objective, space.box(), random, job->observer);
  if (baseline.termination == SearchTermination::kInterrupted) job->watch.MarkStopped();
  const std::vector<double> p = DeviceAt(space, *job, baseline.best.x.data());
  report->rmse.random_baseline = BothRmse(report->device, p, job->curve);
}

// Runs the search; returns the elites.
Expected<std::vector<PolishStart>> RunSearch(const SearchSpace& space, FitJob* job,
                                             FitReport* report) {
  const Instant begin = Now();
  Box box = space.box();
  if (job->options.search.algorithm == Algorithm::kMloKnees) {
    const std::vector<PolishStart> starts = ShapeStarts(*job);
    box.suggested = Suggestions(space, job->coarse, starts);
    report->curve_evaluations = static_cast<std::int64_t>(starts.size());
  }
  const double getting_ready = SecondsSince(begin);
  const ObjectiveFunction objective = [&report,
                                       rmse = RmseIn(space, job->coarse)](const double* x) {
    ++report->curve_evaluations;
    return rmse(x);
  };
  const SearchFunction& searcher = job->options.searcher;
  report->search = searcher ? searcher(objective, box, job->options.search, job->observer)
                            : Search(objective, box, job->options.search, job->observer);
  report->search.seconds += getting_ready;
  if (searcher || job->coarse.points.size < job->problem.points.size) {
    const auto valid = CheckCandidates(RmseIn(space, job->problem), box, &report->search);
    if (!valid) return tl::unexpected(valid.error());
  }
  if (report->search.termination == SearchTermination::kInterrupted) job->watch.MarkStopped();
  const bool is_random = job->options.search.algorithm == Algorithm::kRandom;
  if (job->options.random_baseline && !is_random && !job->watch.stopped()) {
    RunRandomBaseline(job, RmseIn(space, job->coarse), space, report);
  }
  std::vector<PolishStart> elites;
  for (const Candidate& candidate : report->search.elites) {
    elites.push_back(
        {elites.empty() ? "best candidate" : fmt::format("elite {}", elites.size() + 1),
         DeviceAt(space, *job, candidate.x.data()), space.VariantAt(candidate.x.data())});
  }
  return elites;
}

// Statistics of the residuals of the distinct readings, without duplicates.
ResidualStatistics StatisticsOfDistinct(const FitJob& job, const std::vector<double>& p) {
  std::vector<double> residual =
      SolveCurrents(job.problem.device, p.data(), job.problem.points, *job.problem.kernel);
  for (std::size_t k = 0; k < residual.size(); ++k) residual[k] -= job.distinct.current_A[k];
  return FindResidualStatistics(job.distinct.voltage_V, residual);
}

// Fills the results that follow from the parameters: RMSEs, key points, residuals, criteria.
void FillResults(const FitJob& job, FitReport* report) {
  const IvCurve& curve = job.curve;
  const Device& device = report->device;
  report->rmse.searched = BothRmse(device, report->searched, curve);
  if (report->polished) {
    const std::vector<double>& candidate = report->refined_best_candidate;
    if (!candidate.empty())
      report->rmse.refined_best_candidate = BothRmse(device, candidate, curve);
    report->rmse.refined = BothRmse(device, report->refined, curve);
  }
  const std::vector<double>& p = report->refined;
  report->nNsVth = p[IdealityIndex(0)] * device.module_thermal_voltage_V;
  report->measured = FindKeyPoints(curve.voltage_V, curve.current_A);
  report->simulated = ModelKeyPoints(device, p.data());
  const bool all = job.problem.voltage_V.size() == curve.size();
  report->model_current_A = SolveCurrents(
      device, p.data(), all ? job.problem.points : MakePointSet(curve.voltage_V, curve.current_A),
      *job.problem.kernel);
  report->residual_A.clear();
  for (std::size_t k = 0; k < curve.size(); ++k) {
    report->residual_A.push_back(report->model_current_A[k] - curve.current_A[k]);
  }
  const RefineProblem& problem = job.problem;
  const double mean_square =
      MeanSquare(device, problem.objective, p.data(), problem.points, *problem.kernel);
  report->criteria = FindInformation(mean_square, job.readings(), job.free_parameters);
  report->residuals = all ? FindResidualStatistics(curve.voltage_V, report->residual_A)
                          : StatisticsOfDistinct(job, p);
  report->not_usable_because =
      WhyNotUsable(*report, job.watch.stopped(), job.options.loss != Loss::kSquared);
  report->usable = report->not_usable_because.empty();
}

// Proves the floor: the lowest RMSE that any number of diodes can reach.
void FindFloor(FitJob* job, FitReport* report) {
  if (!job->options.floor || job->watch.Stop()) return;
  if (!report->usable) {
    report->warnings.emplace_back("No floor was looked for: the fit is not usable.");
    return;
  }
  const FitOptions& options = job->options;
  const double refined_A =
      BothRmse(report->device, report->refined, job->curve).Of(options.objective);
  CertifyOptions ranges = RangesOf(job->bounds, options.constants, {});
  ranges.objective = options.objective;
  bool interrupted = false;
  Expected<FloorReport> floor =
      ProveFloor(job->curve, ranges, refined_A, job->observer, &interrupted);
  if (interrupted) job->watch.MarkStopped();
  if (!floor) {
    report->warnings.push_back("No floor was found: " + floor.error().message + ".");
    return;
  }
  const bool weighed = report->errors && report->errors->weighed;
  floor->minimised =
      job->curve.sigma_A.empty() && options.loss == Loss::kSquared && !weighed && options.polish;
  report->floor = *floor;
}

// Runs one bounded solve from the best candidate, and separately its full polish.
void PolishPlainly(const PolishStart& candidate, FitJob* job, FitReport* report) {
  const bool extended = !job->variants.empty();
  const RefineProblem problem =
      extended ? InVariant(job->problem, job->variants[candidate.variant], candidate.p)
               : job->problem;
  RefineOptions how;
  how.stop = job->watch.stop();
  how.evaluation_limit = true;
  Instant begin = Now();
  const RefineEnd plain = RefinePlainly(problem, candidate.p, how);
  report->plain_seconds = SecondsSince(begin);
  report->rmse.plain_polished = BothRmse(report->device, plain.p, job->curve);
  begin = Now();
  report->refined_best_candidate =
      extended ? Refine(problem, candidate.p, how).p
               : PolishStarts(problem, job->coarse, {candidate}, &job->watch).first.p;
  report->refine.best_candidate_seconds = SecondsSince(begin);
}

std::string TooFewReadings(const FitJob& job) {
  return fmt::format("{} different readings fix {} parameters without a remainder", job.readings(),
                     job.free_parameters);
}

// Polishes, finds intervals if the fit is usable, and reports how the polish ended.
void PolishAndJudge(FitJob* job, const std::vector<PolishStart>& elites, const SearchSpace& space,
                    FitReport* report) {
  const FitOptions& options = job->options;
  const bool extended = !job->variants.empty();
  PolishResult polish =
      extended ? PolishExtended(elites, space, job, report)
               : PolishStarts(job->problem, job->coarse,
                              CollectStarts(job->coarse, elites, kGridStarts), &job->watch);
  report->polished = true;
  const double best_candidate_seconds = report->refine.best_candidate_seconds;
  report->refine = polish.report;
  report->refine.best_candidate_seconds = best_candidate_seconds;
  const bool of_candidate = !extended || options.starts != StartsFrom::kShape;
  if (report->refined_best_candidate.empty() && of_candidate)
    report->refined_best_candidate = polish.first.p;
  if (!report->refined_best_candidate.empty()) {
    OrderAlike(report->device, job->bounds, &report->refined_best_candidate, nullptr);
  }
  RefineEnd end = polish.best;
  if (options.loss != Loss::kSquared) Robustify(options, job->watch.stop(), &job->problem, &end);

  RefineProblem problem = job->problem;
  std::vector<int> degrees;
  if (options.errors.kind != ErrorKind::kWhite) {
    const RmsePair least_squares = BothRmse(report->device, end.p, job->curve);
    const auto weighed = WeighAndRefine(options.errors, job->fitted(), &job->watch, &problem, &end);
    if (weighed) {
      report->errors = weighed->errors;
      report->errors->least_squares = least_squares;
    }
    if (weighed && weighed->found) degrees = DegreesOfWeighed(job, *weighed->found, end);
  }
  OrderAlike(report->device, job->bounds, &end.p, &end.held);
  const std::vector<double> polished = report->refined = end.p;
  FillResults(*job, report);
  const bool saturated = job->readings() <= job->free_parameters;
  if (options.intervals != Intervals::kNone) {
    report->no_intervals_because =
        !report->usable ? "the fit is not usable: around parameters of a curve that the model does "
                          "not describe no interval means anything"
        : saturated     ? TooFewReadings(*job) + ", and nothing is left over to tell how well"
                        : RefutedBound(job, problem, end, *report);
  }
  const Instant begin = Now();
  for (FitPoint& other : polish.ends) OrderAlike(report->device, job->bounds, &other.p, nullptr);
  JudgeAndImprove(job, problem, polish.ends, degrees, &end, report);
  if (saturated) {
    for (Estimate& e : report->estimates) {
      if (e.fixed) continue;
      e.identifiable = false;
      e.reason = TooFewReadings(*job);
    }
  }
  if (!report->errors && options.find_errors)
    FindIntervalsUnderErrors(job, polish.ends, end, report);
  if (report->refined != polished) FillResults(*job, report);
  report->refine.projected_gradient = end.projected_gradient;
  report->interval_seconds = SecondsSince(begin);
}

}  // namespace

Expected<FitReport> Fit(const IvCurve& curve, const FitOptions& options, const Observer& observer) {
  FitReport report;
  FitJob job{curve, options, observer, {}, {}, 0, {}, {}, FitWatch(observer), {}};
  TRY(PrepareFit(&job, &report));
  report.version = Version();
  report.curve = curve;
  report.model = options.model;
  report.objective = options.objective;
  report.constants = options.constants;
  report.bounds_name = options.bounds.name;
  report.search_options = options.search;
  report.non_default_options = NonDefaults(options, kFitOptionTable);

  const SearchSpace space = SpaceOf(job);
  TRY(const auto candidates, RunSearch(space, &job, &report));
  const PolishStart& best = candidates.front();
  report.searched = report.refined = best.p;
  OrderAlike(report.device, job.bounds, &report.searched, nullptr);
  const bool extended = !job.variants.empty();
  if (extended) report.best_candidate_penalty = VariantPenaltyOf(job, best.variant);
  if (options.plain_polish) PolishPlainly(best, &job, &report);
  if (options.polish) {
    PolishAndJudge(&job, candidates, space, &report);
  } else {
    if (extended) SelectVariant(best.variant, best.p, &job, &report);
    report.refined = report.searched;
    report.estimates = EstimatesOf(job, report);
    FillResults(job, &report);
  }
  report.interrupted = job.watch.stopped();
  report.warnings = FindWarnings(report);
  FindFloor(&job, &report);
  report.interrupted = job.watch.stopped();
  return report;
}

}  // namespace lyrefit
