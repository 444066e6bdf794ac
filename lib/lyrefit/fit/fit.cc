#include "lyrefit/fit/fit.h"

#include <fmt/format.h>

#include <cmath>

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
#include "lyrefit/fit/search_candidates.h"
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

// Evaluates as many random points as the search did and reports the best one.
void RunRandomBaseline(FitJob* job, const ObjectiveFunction& objective, SearchCandidates* places,
                       FitReport* report) {
  SearchOptions random = job->options.search;
  random.algorithm = Algorithm::kRandom;
  random.max_evaluations = std::max<std::int64_t>(report->search.evaluations, 4);
  random.target = -kInfinity;
  random.patience = 0;
  const SearchSummary baseline = Search(objective, places->box(), random, job->observer);
  if (baseline.termination == SearchTermination::kInterrupted) job->progress.stop().Request();
  const std::vector<double> p = places->DeviceAt(baseline.best.x.data());
  report->rmse.random_baseline = BothRmse(report->device, p, job->curve);
}

// Runs the search; returns the elites.
Expected<std::vector<PolishStart>> RunSearch(FitJob* job, FitReport* report) {
  const Instant begin = Now();
  SearchCandidates coarse(*job, job->coarse), all(*job, job->problem);
  TRY(coarse.Check());
  if (job->options.search.algorithm == Algorithm::kMloKnees) coarse.Suggest(ShapeStarts(*job));
  const double getting_ready = SecondsSince(begin);
  const Box& box = coarse.box();
  const ObjectiveFunction objective = [&](const double* x) { return coarse.RmseAt(x); };
  const SearchFunction& searcher = job->options.searcher;
  report->search = searcher ? searcher(objective, box, job->options.search, job->observer)
                            : Search(objective, box, job->options.search, job->observer);
  report->search.seconds += getting_ready;
  report->curve_evaluations = coarse.evaluations();
  if (searcher || job->coarse.points.size < job->problem.points.size) {
    const auto valid =
        CheckCandidates([&](const double* x) { return all.RmseAt(x); }, box, &report->search);
    if (!valid) return tl::unexpected(valid.error());
  }
  if (report->search.termination == SearchTermination::kInterrupted) job->progress.stop().Request();
  const bool is_random = job->options.search.algorithm == Algorithm::kRandom;
  if (job->options.random_baseline && !is_random && !job->progress.stop().requested()) {
    RunRandomBaseline(job, objective, &coarse, report);
  }
  std::vector<PolishStart> elites;
  for (const Candidate& candidate : report->search.elites) {
    elites.push_back(
        {elites.empty() ? "best candidate" : fmt::format("elite {}", elites.size() + 1),
         all.DeviceAt(candidate.x.data()), all.VariantAt(candidate.x.data())});
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
      WhyNotUsable(*report, job.progress.stop().requested(), job.options.loss != Loss::kSquared);
  report->usable = report->not_usable_because.empty();
}

// Proves the floor: the lowest RMSE that any number of diodes can reach.
void FindFloor(FitJob* job, FitReport* report) {
  if (!job->options.floor || job->progress.Stopped()) return;
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
  if (interrupted) job->progress.stop().Request();
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
  how.stop = job->progress.stop();
  how.evaluation_limit = true;
  Instant begin = Now();
  const RefineEnd plain = RefinePlainly(problem, candidate.p, how);
  report->plain_seconds = SecondsSince(begin);
  report->rmse.plain_polished = BothRmse(report->device, plain.p, job->curve);
  begin = Now();
  report->refined_best_candidate =
      extended ? Refine(problem, candidate.p, how).p
               : PolishStarts(problem, job->coarse, {candidate}, job->progress).first.p;
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
                              CollectStarts(job->coarse, elites, kGridStarts), job->progress);
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
  if (options.loss != Loss::kSquared) Robustify(options, job->progress.stop(), &job->problem, &end);

  RefineProblem problem = job->problem;
  std::vector<int> degrees;
  if (options.errors.kind != ErrorKind::kWhite) {
    const RmsePair least_squares = BothRmse(report->device, end.p, job->curve);
    const auto weighed =
        WeighAndRefine(options.errors, job->fitted(), job->progress, &problem, &end);
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
  FitJob job{curve, options, observer, {}, {}, 0, {}, {}, ProgressReporter(observer, 0), {}};
  TRY(PrepareFit(&job, &report));
  report.version = Version();
  report.curve = curve;
  report.model = options.model;
  report.objective = options.objective;
  report.constants = options.constants;
  report.bounds_name = options.bounds.name;
  report.search_options = options.search;
  report.non_default_options = NonDefaults(options, kFitOptionTable);

  TRY(const auto candidates, RunSearch(&job, &report));
  const PolishStart& best = candidates.front();
  report.searched = report.refined = best.p;
  OrderAlike(report.device, job.bounds, &report.searched, nullptr);
  const bool extended = !job.variants.empty();
  if (extended) report.best_candidate_penalty = VariantPenaltyOf(job, best.variant);
  if (options.plain_polish) PolishPlainly(best, &job, &report);
  if (options.polish) {
    PolishAndJudge(&job, candidates, CompleteSpace(job), &report);
  } else {
    if (extended) SelectVariant(best.variant, best.p, &job, &report);
    report.refined = report.searched;
    report.estimates = EstimatesOf(job, report);
    FillResults(job, &report);
  }
  report.interrupted = job.progress.stop().requested();
  report.warnings = FindWarnings(report);
  FindFloor(&job, &report);
  report.interrupted = job.progress.stop().requested();
  return report;
}

}  // namespace lyrefit
