#include "lyrefit/devices/fit_two_junctions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/seconds.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/devices/two_junction_judge.h"
#include "lyrefit/devices/two_junction_problem.h"
#include "lyrefit/devices/two_junction_starts.h"
#include "lyrefit/estimate/refine/multistart.h"
#include "lyrefit/search/search.h"

namespace lyrefit {
namespace {

constexpr double kMostMisfit = 0.03;  // of Isc, as for one curve (fit/usable.h)
constexpr double kSameEnd = 1e-9;     // relative difference of mean squares in one optimum
constexpr double kNearBest = 1.5;     // mean square of an end that may lie inside the intervals
constexpr std::size_t kMostOthers = 4;

struct Descent : MultistartEnd {
  RefineEnd end;
  std::string origin;
  double start_mean_square = HUGE_VAL;
};

bool IsSameEnd(const MultistartEnd& a, const MultistartEnd& b) {
  return std::fabs(a.value - b.value) <= kSameEnd * std::max(a.value, b.value);
}

Expected<void> ValidateAll(const TwoJunctionOptions& options) {
  TRY(ValidateThreads(options.threads));
  TRY(ValidateOptions(options, kTwoJunctionOptionTable));
  return ValidateOptions(options.search, kSearchOptionTable);
}

std::vector<Descent> StartsOf(const PreparedTwoJunctions& prepared, const SearchSummary& search) {
  std::vector<Descent> starts;
  const auto add = [&](const std::vector<double>& x, std::string origin) {
    Descent start;
    start.end.p = ParametersAt(prepared, x.data());
    start.origin = std::move(origin);
    starts.push_back(std::move(start));
  };
  for (std::size_t k = 0; k < search.elites.size(); ++k) {
    add(search.elites[k].x, k == 0 ? "best candidate" : fmt::format("elite {}", k + 1));
  }
  for (const std::vector<double>& x : TwoJunctionStarts(prepared)) add(x, "shape");
  return starts;
}

// Few steps for all starts, more for the better ones, then the best to convergence.
Multistart<Descent> Polish(const TwoJunctionModel& model, std::vector<Descent> starts,
                           const TwoJunctionOptions& options, const ProgressReporter& progress) {
  const StopToken& stop = progress.stop();
  const auto refine = [&](const MultistartStage& stage, Descent* at) {
    RefineOptions how;
    how.stop = stop;
    if (stage.steps > 0) {
      how.small = true;
      how.max_rounds = 0;
      how.first_iterations = stage.steps;
      how.trust_radius = 1e4;
    }
    if (!std::isfinite(at->start_mean_square)) at->start_mean_square = model.MeanSquare(at->end);
    at->end = RefineModel(model, at->end, how);
    at->value = at->end.mean_square;
  };
  MultistartRules rules;
  rules.stages = {{10, 16}, {40, 6}};
  rules.apart = 1e-7;
  rules.visits = 3;
  rules.threads = options.threads;
  Multistart<Descent> run;
  RunMultistart(rules, std::move(starts), refine, IsSameEnd, &run);
  return run;
}

void DescribeStarts(const Multistart<Descent>& run, TwoJunctionReport* report) {
  for (const Descent& descent : run.ends) {
    if (!descent.finished) continue;
    report->starts.push_back({descent.origin, std::sqrt(descent.start_mean_square),
                              std::sqrt(descent.value), IsSameEnd(descent, run.Best())});
  }
}

// The best end with the junctions in each other's place, refined.
FitPoint Exchanged(const PreparedTwoJunctions& prepared, const TwoJunctionModel& model,
                   FitPoint best, const StopToken& stop) {
  std::vector<double>& p = best.p;
  for (int i = 1; i < JunctionPhotocurrent(1); ++i) std::swap(p[i], p[JunctionPhotocurrent(1) + i]);
  if (prepared.problem.ordered) p[JunctionPhotocurrent(1)] = 0.01;
  RefineOptions how;
  how.stop = stop;
  return RefineModel(model, std::move(best), how);
}

// Distinct ends of the other starts, the best first, and the exchanged junctions.
std::vector<FitPoint> OtherOptima(const PreparedTwoJunctions& prepared,
                                  const TwoJunctionModel& model, const Multistart<Descent>& run,
                                  const StopToken& stop) {
  std::vector<const Descent*> others;
  for (const Descent& descent : run.ends) {
    const bool near = descent.value < kNearBest * run.Best().value;
    if (near && !IsSameEnd(descent, run.Best())) others.push_back(&descent);
  }
  std::stable_sort(others.begin(), others.end(),
                   [](const Descent* a, const Descent* b) { return a->value < b->value; });
  std::vector<FitPoint> points = {Exchanged(prepared, model, run.Best().end, stop)};
  for (const Descent* descent : others) {
    if (points.size() < kMostOthers) points.push_back(descent->end);
  }
  return points;
}

void DescribeCurves(const CurveSet& set, const PreparedTwoJunctions& prepared,
                    const std::vector<double>& p, TwoJunctionReport* report) {
  const TwoJunctionProblem& problem = prepared.problem;
  for (std::size_t c = 0; c < set.curves.size(); ++c) {
    TwoJunctionCurveReport one;
    one.curve = set.curves[c];
    one.light = prepared.light[c];
    const auto device = DeviceIn(problem, static_cast<int>(c), p.data());
    one.parameters.assign(device.begin(), device.end());
    one.limiting = device[JunctionPhotocurrent(0)] <= device[JunctionPhotocurrent(1)] ? 1 : 2;
    double sum = 0;
    for (std::size_t k = 0; k < one.curve.size(); ++k) {
      one.model_A.push_back(
          TwoJunctionCurrent(problem.thermal_voltage_V, device.data(), one.curve.voltage_V[k]));
      const double residual = one.model_A.back() - one.curve.current_A[k];
      sum += residual * residual;
    }
    one.rmse_A = std::sqrt(sum / static_cast<double>(one.curve.size()));
    one.measured = FindKeyPoints(one.curve.voltage_V, one.curve.current_A);
    one.simulated = TwoJunctionKeyPoints(problem.thermal_voltage_V, device.data());
    report->curves.push_back(std::move(one));
  }
}

void Warn(const CurveSet& set, const PreparedTwoJunctions& prepared, TwoJunctionReport* report) {
  if (!report->converged && !report->interrupted) {
    report->warnings.push_back("the polish did not converge");
  }
  for (const IvCurve& curve : set.curves) {
    for (const Assumption& assumption : curve.assumptions) {
      if (set.curves.size() == 1) report->warnings.push_back(assumption.sentence);
    }
  }
  const double misfit = report->refined_rmse_A / prepared.problem.current_scale_A;
  if (misfit <= kMostMisfit) return;
  report->usable = false;
  report->not_usable_because =
      fmt::format("two junctions miss the readings by {:.2g} % of Isc", 100 * misfit);
}

}  // namespace

Expected<TwoJunctionReport> FitTwoJunctions(const CurveSet& set, const TwoJunctionOptions& options,
                                            const Observer& observer) {
  TRY(ValidateAll(options));
  TRY(const PreparedTwoJunctions prepared, PrepareTwoJunctions(set, options));
  const TwoJunctionProblem& problem = prepared.problem;
  const TwoJunctionModel model(problem);
  const ProgressReporter progress(observer);
  TwoJunctionReport report;
  report.version = Version();
  report.name = set.name;
  report.constants = options.constants;
  report.temperature_K = set.curves.front().conditions.cell_temperature_K;
  report.interchangeable = problem.ordered;
  report.search_options = options.search;
  report.non_default_options = NonDefaults(options, kTwoJunctionOptionTable);

  Box box = TwoJunctionBox(prepared);
  if (options.search.algorithm == Algorithm::kMloShape) box.initial = TwoJunctionStarts(prepared);
  const ObjectiveFunction objective = [&](const double* x) {
    return std::sqrt(model.MeanSquare({ParametersAt(prepared, x), {}}));
  };
  report.search = Search(objective, box, options.search, observer);
  if (report.search.termination == SearchTermination::kInterrupted) progress.stop().Request();
  const std::vector<double> searched = ParametersAt(prepared, report.search.best.x.data());
  report.searched_rmse_A = std::sqrt(model.MeanSquare({searched, {}}));

  Instant begin = Now();
  progress.Begin("polish", 0);
  const Multistart<Descent> run =
      Polish(model, StartsOf(prepared, report.search), options, progress);
  report.refine_seconds = SecondsSince(begin);
  DescribeStarts(run, &report);
  TwoJunctionEnd end{run.Best().end, OtherOptima(prepared, model, run, progress.stop())};
  begin = Now();
  progress.Begin("intervals", 0);
  // Around parameters of curves that the model does not describe no interval means anything.
  TwoJunctionOptions judging = options;
  const double misfit = std::sqrt(end.best.mean_square) / problem.current_scale_A;
  if (misfit > kMostMisfit) judging.intervals = Intervals::kNone;
  JudgeTwoJunctions(prepared, judging, searched, progress, &end, &report);
  report.interval_seconds = SecondsSince(begin);
  report.converged = end.best.converged;
  report.projected_gradient = end.best.projected_gradient;
  report.refined_rmse_A = std::sqrt(end.best.mean_square);
  report.interrupted = progress.stop().requested();
  DescribeCurves(set, prepared, end.best.p, &report);
  Warn(set, prepared, &report);
  return report;
}

Expected<CurveSet> GatherCurves(std::vector<CurveSet> sets) {
  CurveSet all;
  for (CurveSet& set : sets) {
    if (all.name.empty()) all.name = sets.size() == 1 ? set.name : set.curves.front().name;
    for (IvCurve& curve : set.curves) {
      const bool twice =
          std::any_of(all.curves.begin(), all.curves.end(),
                      [&](const IvCurve& other) { return other.name == curve.name; });
      if (twice) return Fail("two curves are named " + curve.name, curve.source);
      all.curves.push_back(std::move(curve));
    }
  }
  if (sets.size() > 1) all.name += fmt::format(" and {} more", sets.size() - 1);
  return all;
}

TwoJunctionOptions WithOptionsOf(const FitOptions& fit, TwoJunctionOptions options) {
  options.bounds = fit.bounds.overrides;
  options.fixed = fit.fixed;
  options.constants = fit.constants;
  options.search = fit.search;
  options.intervals = fit.intervals;
  options.threads = fit.threads;
  return options;
}

}  // namespace lyrefit
