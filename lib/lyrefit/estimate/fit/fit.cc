#include "lyrefit/estimate/fit/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "lyrefit/base/seconds.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/curve/dark.h"
#include "lyrefit/estimate/fit/descents.h"
#include "lyrefit/estimate/fit/judge_fit.h"
#include "lyrefit/estimate/fit/polish.h"
#include "lyrefit/estimate/fit/prepare_fit.h"
#include "lyrefit/estimate/fit/refine_fit.h"
#include "lyrefit/estimate/fit/search_space.h"
#include "lyrefit/estimate/fit/statistics.h"
#include "lyrefit/estimate/fit/usable.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/search/search.h"

namespace lyrefit {
namespace {

// Second stage of a fit: the search and its best candidates.
struct SearchedFit {
  SearchSummary summary;
  std::vector<PolishStart> candidates;      // best first; at least one
  std::int64_t curve_evaluations = 0;       // see FitReport
  std::optional<RmsePair> random_baseline;  // best of as many random points, if requested
};

// RMSE of the points of the search space on the points of a problem, in the objective of the fit,
// in ampere. Space and problem must outlive the function.
ObjectiveFunction RmseIn(const SearchSpace& space, const RefineProblem& problem) {
  std::vector<double> p(problem.device.size());
  return [&space, &problem, p](const double* x) mutable {
    space.ToParameters(x, p.data());
    return std::sqrt(MeanSquare(problem, p));
  };
}

std::vector<double> DeviceAt(const SearchSpace& space, const PreparedFit& fit, const double* x) {
  std::vector<double> p(fit.problem.device.size());
  space.ToParameters(x, p.data());
  return p;
}

// Starts as points of the search space, sorted by rank within their variant: the best of each
// variant first, then the second of each. Costs one evaluation of the objective each.
std::vector<std::vector<double>> InitialPoints(const SearchSpace& space,
                                               const RefineProblem& problem,
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
  std::vector<std::vector<double>> initial;
  initial.reserve(places.size());
  for (const Place& place : places) {
    initial.push_back(space.FromParameters(place.start->p.data(), place.start->variant));
  }
  return initial;
}

// RMSE of the best of as many random points as the search evaluated.
RmsePair RandomBaseline(const PreparedFit& fit, const SearchSpace& space, std::int64_t evaluations,
                        const Observer& observer, const ProgressReporter& progress) {
  SearchOptions random = fit.options.search;
  random.algorithm = Algorithm::kRandom;
  random.max_evaluations = std::max<std::int64_t>(evaluations, 4);
  random.target = -kInfinity;
  random.patience = 0;
  const SearchSummary baseline = Search(RmseIn(space, fit.coarse), space.box(), random, observer);
  if (baseline.termination == SearchTermination::kInterrupted) progress.stop().Request();
  return BothRmse(fit.device, DeviceAt(space, fit, baseline.best.x.data()), fit.curve);
}

// Searches `space`, which is SpaceOf(fit). Error: a user's own search gave no valid candidate.
Expected<SearchedFit> SearchFit(const PreparedFit& fit, const SearchSpace& space,
                                const Observer& observer, const ProgressReporter& progress) {
  const FitOptions& options = fit.options;
  const Instant begin = Now();
  SearchedFit searched;
  Box box = space.box();
  if (options.search.algorithm == Algorithm::kMloShape) {
    const std::vector<PolishStart> starts = ShapeStarts(fit);
    box.initial = InitialPoints(space, fit.coarse, starts);
    searched.curve_evaluations = static_cast<std::int64_t>(starts.size());
  }
  const ObjectiveFunction objective = [&searched,
                                       rmse = RmseIn(space, fit.coarse)](const double* x) {
    ++searched.curve_evaluations;
    return rmse(x);
  };
  SearchSummary& summary = searched.summary;
  summary = options.searcher ? options.searcher(objective, box, options.search, observer)
                             : Search(objective, box, options.search, observer);
  summary.seconds = SecondsSince(begin);
  if (options.searcher || fit.coarse.points.size < fit.problem.points.size) {
    TRY(CheckCandidates(RmseIn(space, fit.problem), box, &summary));
  }
  if (summary.termination == SearchTermination::kInterrupted) progress.stop().Request();
  const bool is_random = options.search.algorithm == Algorithm::kRandom;
  if (options.random_baseline && !is_random && !progress.stop().requested()) {
    searched.random_baseline = RandomBaseline(fit, space, summary.evaluations, observer, progress);
  }
  for (const Candidate& candidate : summary.elites) {
    const std::size_t rank = searched.candidates.size() + 1;
    searched.candidates.push_back({rank == 1 ? "best candidate" : fmt::format("elite {}", rank),
                                   DeviceAt(space, fit, candidate.x.data()),
                                   space.VariantAt(candidate.x.data())});
  }
  return searched;
}

// Statistics of the residuals of the distinct readings, without duplicates.
ResidualStatistics StatisticsOfDistinct(const PreparedFit& fit, const std::vector<double>& p) {
  std::vector<double> residual =
      SolveCurrents(fit.problem.device, p.data(), fit.problem.points, *fit.problem.kernel);
  for (std::size_t k = 0; k < residual.size(); ++k) residual[k] -= fit.distinct.current_A[k];
  return FindResidualStatistics(fit.distinct.voltage_V, residual);
}

// A parameter vector and what follows from it.
struct Answer {
  std::vector<double> p;
  RmsePair rmse;
  InformationCriteria criteria;
  std::string not_usable_because;
  ModelResults results;
};

// `at_its_end`: the parameters were polished without an interruption.
Answer AnswerAt(const PreparedFit& fit, const std::vector<double>& p, bool at_its_end) {
  const IvCurve& curve = fit.curve;
  const RefineProblem& problem = fit.problem;
  Answer answer{p, BothRmse(fit.device, p, curve), {}, {}, {}};
  ModelResults& results = answer.results;
  results.nNsVth = p[IdealityIndex(0)] * fit.device.module_thermal_voltage_V;
  if (!IsDark(curve)) {  // in the dark a current of 0 is at 0 V, or where an offset has it
    results.measured = FindKeyPoints(curve.voltage_V, curve.current_A);
    results.simulated = ModelKeyPoints(fit.device, p.data());
  }
  const bool all = problem.voltage_V.size() == curve.size();
  results.model_current_A = SolveCurrents(
      fit.device, p.data(), all ? problem.points : MakePointSet(curve.voltage_V, curve.current_A),
      *problem.kernel);
  for (std::size_t k = 0; k < curve.size(); ++k) {
    results.residual_A.push_back(results.model_current_A[k] - curve.current_A[k]);
  }
  const double mean_square =
      MeanSquare(fit.device, problem.objective, p.data(), problem.points, *problem.kernel);
  answer.criteria = FindInformation(mean_square, fit.readings(), fit.free_parameters);
  results.residuals = all ? FindResidualStatistics(curve.voltage_V, results.residual_A)
                          : StatisticsOfDistinct(fit, p);
  answer.not_usable_because =
      WhyNotUsable(curve, results,
                   {answer.criteria, answer.rmse.solved_current_A, at_its_end,
                    fit.options.loss != Loss::kSquared, !fit.doubts.empty()});
  return answer;
}

// The part of the report that is known after the search.
FitReport SearchReport(const PreparedFit& fit, const SearchedFit& searched) {
  const FitOptions& options = fit.options;
  FitReport report;
  report.version = Version();
  report.curve = fit.curve;
  report.model = options.model;
  report.objective = options.objective;
  report.constants = options.constants;
  report.bounds_name = options.bounds.name;
  report.steepest_n = fit.steepest_n;
  report.doubts = fit.doubts;
  for (const EffectUse& use : options.with) report.causes.push_back(use.effect->id);
  report.search_options = options.search;
  report.non_default_options = NonDefaults(options, kFitOptionTable);
  const PolishStart& best = searched.candidates.front();
  report.search = searched.summary;
  report.curve_evaluations = searched.curve_evaluations;
  if (searched.random_baseline) report.rmse.random_baseline = *searched.random_baseline;
  report.searched = best.p;
  OrderAlike(fit.device, fit.bounds, &report.searched, nullptr);
  report.rmse.searched = BothRmse(fit.device, report.searched, fit.curve);
  if (fit.extended()) report.best_candidate_penalty = VariantPenaltyOf(fit, best.variant);
  return report;
}

// The report with its answer. `fit`: in the selected variant.
FitReport WithAnswer(FitReport report, const PreparedFit& fit, Answer answer) {
  report.device = fit.device;
  report.variant_penalty = fit.variant_penalty;
  static_cast<ModelResults&>(report) = std::move(answer.results);
  report.criteria = answer.criteria;
  report.not_usable_because = std::move(answer.not_usable_because);
  report.usable = report.not_usable_because.empty();
  report.refined = std::move(answer.p);
  return report;
}

// The course of the polish, with restarts by the profiles and the best candidate's own polish.
RefineReport CourseOf(const RefinedFit& refined, const JudgedFit& judged,
                      const std::optional<PlainPolish>& plain) {
  RefineReport course = refined.report;
  for (const StartReport& restart : judged.restarts) {
    for (StartReport& start : course.starts) start.agrees = false;
    course.starts.push_back(restart);
    course.winner = static_cast<int>(course.starts.size()) - 1;
    course.agreeing = 1;
  }
  course.projected_gradient = judged.end.projected_gradient;
  course.condition = judged.condition;
  if (plain) course.best_candidate_seconds = plain->best_candidate_seconds;
  return course;
}

// A fit within given bounds, and those of them that its readings refute.
struct BoundedFit {
  FitReport report;
  RefutedBounds refuted;
};

// Polishes the search's candidates, and judges the end.
BoundedFit PolishedReport(FitReport report, const PreparedFit& prepared,
                          const SearchedFit& searched, const SearchSpace& space,
                          const std::optional<PlainPolish>& plain,
                          const ProgressReporter& progress) {
  const RefinedFit refined = RefineFit(prepared, searched.candidates, space, progress);
  const PreparedFit& fit = refined.prepared;
  const auto answer_at = [&](const std::vector<double>& p) {
    return AnswerAt(fit, p, !progress.stop().requested());
  };
  Answer answer = answer_at(refined.end.p);
  const Instant begin = Now();
  JudgedFit judged =
      JudgeFit(refined, report.searched, answer.not_usable_because.empty(), progress);
  report.interval_seconds = SecondsSince(begin);
  if (judged.end.p != refined.end.p) answer = answer_at(judged.end.p);

  report.polished = true;
  report.refine = CourseOf(refined, judged, plain);
  report.variants = refined.variants;
  if (report.refined_best_candidate.empty()) {
    report.refined_best_candidate = refined.best_candidate;
  }
  std::vector<double>& candidate = report.refined_best_candidate;
  if (!candidate.empty()) {
    OrderAlike(fit.device, fit.bounds, &candidate, nullptr);
    report.rmse.refined_best_candidate = BothRmse(fit.device, candidate, fit.curve);
  }
  report.rmse.refined = answer.rmse;
  report.estimates = std::move(judged.estimates);
  report.correlations = std::move(judged.correlations);
  report.covariance = std::move(judged.covariance);
  report.no_intervals_because = std::move(judged.no_intervals_because);
  report.errors = judged.errors;
  report.under_errors = std::move(judged.under_errors);
  return {WithAnswer(std::move(report), fit, std::move(answer)), std::move(judged.refuted)};
}

// Without a polish the best candidate is the answer.
BoundedFit UnpolishedReport(FitReport report, const PreparedFit& prepared,
                            const PolishStart& best) {
  const PreparedFit fit =
      prepared.extended() ? WithVariant(prepared, best.variant, best.p) : prepared;
  report.estimates = EstimatesOf(fit, report.searched, {});
  Answer answer = AnswerAt(fit, report.searched, false);
  return {WithAnswer(std::move(report), fit, std::move(answer)), {}};
}

Expected<BoundedFit> FitWithinBounds(const IvCurve& curve, const FitOptions& options,
                                     const Observer& observer) {
  TRY(const PreparedFit prepared, PrepareFit(curve, options));
  const ProgressReporter progress(observer, 0);
  const SearchSpace space = SpaceOf(prepared);
  TRY(const SearchedFit searched, SearchFit(prepared, space, observer, progress));
  const PolishStart& best = searched.candidates.front();
  FitReport report = SearchReport(prepared, searched);
  std::optional<PlainPolish> plain;
  if (options.plain_polish) {
    plain = PolishPlainly(prepared, best, progress);
    report.rmse.plain_polished = plain->rmse;
    report.plain_seconds = plain->seconds;
    report.refined_best_candidate = plain->best_candidate;
    report.refine.best_candidate_seconds = plain->best_candidate_seconds;
  }
  BoundedFit fit =
      options.polish ? PolishedReport(std::move(report), prepared, searched, space, plain, progress)
                     : UnpolishedReport(std::move(report), prepared, best);
  fit.report.interrupted = progress.stop().requested();
  return fit;
}

// Whether bounds that are refuted give way: an upper one of n of one diode, which lyrefit chose. Two
// diodes take each other's place in such room. Below the lower one no junction is. The range of a
// thin film holds collection and barriers already.
bool GiveWay(const RefutedBounds& refuted, const FitReport& report, const FitOptions& options) {
  const bool own = options.bounds.name == "physical" && options.bounds.overrides.empty();
  return own && !refuted.wider.empty() && !options.floor && options.with.empty() &&
         options.model == Model::kSingleDiode && !IsThinFilm(report.curve.notes.technology) &&
         report.estimates[IdealityIndex(0)].at_bound == BoundSide::kUpper;
}

}  // namespace

Expected<FitReport> Fit(const IvCurve& curve, const FitOptions& options, const Observer& observer) {
  TRY(BoundedFit fit, FitWithinBounds(curve, options, observer));
  if (GiveWay(fit.refuted, fit.report, options)) {
    FitOptions wider = options;
    wider.bounds.overrides = fit.refuted.wider;
    IvCurve told = curve;
    const auto& [symbol, range] = *fit.refuted.wider.begin();
    told.assumptions.push_back(fmt::format(
        "{} was given room up to {:g}: {}; check temperature, number of cells and model", symbol,
        range.second, fit.refuted.test));
    TRY(fit, FitWithinBounds(told, wider, observer));
  }
  fit.report.warnings = FindWarnings(fit.report);
  return fit.report;
}

}  // namespace lyrefit
