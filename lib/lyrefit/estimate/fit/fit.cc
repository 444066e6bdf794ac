#include "lyrefit/estimate/fit/fit.h"

#include <cmath>

#include "lyrefit/base/seconds.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/estimate/fit/judge_fit.h"
#include "lyrefit/estimate/fit/order_alike.h"
#include "lyrefit/estimate/fit/prepare_fit.h"
#include "lyrefit/estimate/fit/refine_fit.h"
#include "lyrefit/estimate/fit/search_fit.h"
#include "lyrefit/estimate/fit/statistics.h"
#include "lyrefit/estimate/fit/usable.h"
#include "lyrefit/estimate/fit/warnings.h"
#include "lyrefit/model/current.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {
namespace {

// Statistics of the residuals of the distinct readings, without duplicates.
ResidualStatistics StatisticsOfDistinct(const PreparedFit& fit, const std::vector<double>& p) {
  std::vector<double> residual =
      SolveCurrents(fit.problem.device, p.data(), fit.problem.points, *fit.problem.kernel);
  for (std::size_t k = 0; k < residual.size(); ++k) residual[k] -= fit.distinct.current_A[k];
  return FindResidualStatistics(fit.distinct.voltage_V, residual);
}

// The results at parameters `p`, whose solved-current RMSE is `rmse_A`. `at_its_end`: they were
// polished without an interruption.
ModelResults ResultsAt(const PreparedFit& fit, const std::vector<double>& p, double rmse_A,
                       bool at_its_end) {
  const IvCurve& curve = fit.curve;
  const RefineProblem& problem = fit.problem;
  ModelResults results;
  results.nNsVth = p[IdealityIndex(0)] * fit.device.module_thermal_voltage_V;
  results.measured = FindKeyPoints(curve.voltage_V, curve.current_A);
  results.simulated = ModelKeyPoints(fit.device, p.data());
  const bool all = problem.voltage_V.size() == curve.size();
  results.model_current_A = SolveCurrents(
      fit.device, p.data(), all ? problem.points : MakePointSet(curve.voltage_V, curve.current_A),
      *problem.kernel);
  for (std::size_t k = 0; k < curve.size(); ++k) {
    results.residual_A.push_back(results.model_current_A[k] - curve.current_A[k]);
  }
  const double mean_square =
      MeanSquare(fit.device, problem.objective, p.data(), problem.points, *problem.kernel);
  results.criteria = FindInformation(mean_square, fit.readings(), fit.free_parameters);
  results.residuals = all ? FindResidualStatistics(curve.voltage_V, results.residual_A)
                          : StatisticsOfDistinct(fit, p);
  results.not_usable_because =
      WhyNotUsable(curve, results,
                   {rmse_A, at_its_end, fit.options.loss != Loss::kSquared, !fit.doubts.empty()});
  results.usable = results.not_usable_because.empty();
  return results;
}

// The part of the report that is known before the search.
FitReport Header(const PreparedFit& fit) {
  const FitOptions& options = fit.options;
  FitReport report;
  report.version = Version();
  report.curve = fit.curve;
  report.model = options.model;
  report.objective = options.objective;
  report.constants = options.constants;
  report.bounds_name = options.bounds.name;
  report.steepest_n = fit.steepest_n;
  report.device = fit.device;
  report.doubts = fit.doubts;
  for (const EffectUse& use : options.with) report.causes.push_back(use.effect->id);
  report.search_options = options.search;
  report.non_default_options = NonDefaults(options, kFitOptionTable);
  return report;
}

void AddSearch(const PreparedFit& fit, const SearchedFit& searched, FitReport* report) {
  const PolishStart& best = searched.candidates.front();
  report->search = searched.summary;
  report->curve_evaluations = searched.curve_evaluations;
  if (searched.random_baseline) report->rmse.random_baseline = *searched.random_baseline;
  report->searched = report->refined = best.p;
  OrderAlike(fit.device, fit.bounds, &report->searched, nullptr);
  report->rmse.searched = BothRmse(fit.device, report->searched, fit.curve);
  if (fit.extended()) report->best_candidate_penalty = VariantPenaltyOf(fit, best.variant);
}

// Without a polish the best candidate is the result.
void AddUnpolished(const PreparedFit& fit, FitReport* report) {
  report->device = fit.device;
  report->variant_penalty = fit.variant_penalty;
  report->refined = report->searched;
  report->estimates = EstimatesOf(fit, report->searched, {});
  static_cast<ModelResults&>(*report) =
      ResultsAt(fit, report->refined, report->rmse.searched.solved_current_A, false);
}

// Adds the polish and the intervals.
void AddPolish(const RefinedFit& refined, const ProgressReporter& progress, FitReport* report) {
  const PreparedFit& fit = refined.prepared;
  report->device = fit.device;
  report->variant_penalty = fit.variant_penalty;
  report->polished = true;
  const double best_candidate_seconds = report->refine.best_candidate_seconds;
  report->refine = refined.report;
  report->refine.best_candidate_seconds = best_candidate_seconds;
  report->variants = refined.variants;
  std::vector<double>& candidate = report->refined_best_candidate;
  if (candidate.empty()) candidate = refined.best_candidate;
  if (!candidate.empty()) {
    OrderAlike(fit.device, fit.bounds, &candidate, nullptr);
    report->rmse.refined_best_candidate = BothRmse(fit.device, candidate, fit.curve);
  }
  const auto results_at = [&](const std::vector<double>& p) {
    report->rmse.refined = BothRmse(fit.device, p, fit.curve);
    return ResultsAt(fit, p, report->rmse.refined.solved_current_A, !progress.stop().requested());
  };
  ModelResults results = results_at(refined.end.p);

  const Instant begin = Now();
  JudgedFit judged = JudgeFit(refined, report->searched, results.usable, progress);
  report->interval_seconds = SecondsSince(begin);
  if (judged.end.p != refined.end.p) results = results_at(judged.end.p);
  static_cast<ModelResults&>(*report) = std::move(results);
  for (StartReport& restart : judged.restarts) {
    for (StartReport& start : report->refine.starts) start.agrees = false;
    report->refine.starts.push_back(std::move(restart));
    report->refine.winner = static_cast<int>(report->refine.starts.size()) - 1;
    report->refine.agreeing = 1;
  }
  report->refine.projected_gradient = judged.end.projected_gradient;
  report->refine.condition = judged.condition;
  report->refined = std::move(judged.end.p);
  report->estimates = std::move(judged.estimates);
  report->correlations = std::move(judged.correlations);
  report->no_intervals_because = std::move(judged.no_intervals_because);
  report->errors = judged.errors;
  report->under_errors = std::move(judged.under_errors);
}

}  // namespace

Expected<FitReport> Fit(const IvCurve& curve, const FitOptions& options, const Observer& observer) {
  TRY(const PreparedFit prepared, PrepareFit(curve, options));
  const ProgressReporter progress(observer, 0);
  const SearchSpace space = SpaceOf(prepared);
  TRY(const SearchedFit searched, SearchFit(prepared, space, observer, progress));
  const PolishStart& best = searched.candidates.front();
  FitReport report = Header(prepared);
  AddSearch(prepared, searched, &report);
  if (options.plain_polish) {
    PlainPolish plain = PolishPlainly(prepared, best, progress);
    report.rmse.plain_polished = plain.rmse;
    report.plain_seconds = plain.seconds;
    report.refined_best_candidate = std::move(plain.best_candidate);
    report.refine.best_candidate_seconds = plain.best_candidate_seconds;
  }
  if (options.polish) {
    AddPolish(RefineFit(prepared, searched.candidates, space, progress), progress, &report);
  } else {
    AddUnpolished(prepared.extended() ? WithVariant(prepared, best.variant, best.p) : prepared,
                  &report);
  }
  report.interrupted = progress.stop().requested();
  report.warnings = FindWarnings(report);
  return report;
}

}  // namespace lyrefit
