#include "lyrefit/devices/fit_two_junctions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/try.h"
#include "lyrefit/devices/two_junction_lights.h"
#include "lyrefit/devices/two_junction_problem.h"
#include "lyrefit/estimate/fit/estimate_parameters.h"

namespace lyrefit {
namespace {

constexpr double kMostMisfit = 0.03;  // of Isc, as for one curve (fit/usable.h)
constexpr double kFarOutside = 9;     // rise at which a refit is given up, of that at the end
constexpr IntervalRules kTwoJunctionRules = {
    /*thorough=*/true, /*judge_open_ends=*/false, /*judge_absent_diodes=*/false,
    "no shunt is visible: only a lower limit is known",
    "the data do not fix it: another parameter takes its place"};

Expected<void> ValidateAll(const TwoJunctionOptions& options) {
  TRY(ValidateThreads(options.threads));
  TRY(ValidateOptions(options, kTwoJunctionOptionTable));
  return ValidateOptions(options.search, kSearchOptionTable);
}

// The device has these limits by its nature; to reach one of them says something.
bool IsNaturalEnd(const ParameterInfo& info, bool upper) {
  if (info.kind == ParameterKind::kSeries || info.kind == ParameterKind::kPlain) return !upper;
  return info.kind == ParameterKind::kPhotocurrent && !upper;
}

// The estimates, with marks on parameters that the data limit on one side only.
std::vector<Estimate> WithOpenEnds(std::vector<Estimate> estimates) {
  for (Estimate& e : estimates) {
    if (!e.free() || !e.identifiable || e.interval == IntervalMethod::kNone) continue;
    const bool low = e.low_95 <= e.bounds.lower && !IsNaturalEnd(e.info, /*upper=*/false);
    const bool high = e.high_95 >= e.bounds.upper && !IsNaturalEnd(e.info, /*upper=*/true);
    const bool unsettled = e.interval == IntervalMethod::kUnsettled;
    if (!low && !high && !unsettled) continue;
    e.identifiable = false;
    if (unsettled) {
      e.reason = "an end of its interval was not found";
    } else if (low && high) {
      e.reason = "the data allow its whole range";
    } else if (e.info.kind == ParameterKind::kPhotocurrent ||
               e.info.kind == ParameterKind::kPlain) {
      e.reason = "this junction does not limit the current, so only a lower limit is known";
    } else {
      e.reason = fmt::format("only {} limit is known: the data allow it to the end of its range",
                             low ? "an upper" : "a lower");
    }
  }
  return estimates;
}

// Sum of both junctions' voltages under the reference light at open circuit.
double OpenCircuit(const TwoJunctionProblem& problem, const std::vector<double>& p) {
  return TwoJunctionVoltage(problem.thermal_voltage_V,
                            JunctionsAtReference(problem, p.data()).data(), 0);
}

// The point with the saturation current of junction `j` moved so that the open-circuit voltage is
// `voc_V`. Along a profile, one junction takes the voltage that the other one loses.
FitPoint Compensated(const TwoJunctionModel& model, const TwoJunctionProblem& problem, int j,
                     double voc_V, FitPoint at) {
  const int i = JunctionSaturation(j);
  const FitParameter& parameter = model.shape().parameters[i];
  const double unit_V = problem.thermal_voltage_V * at.p[JunctionIdeality(j)];
  for (int k = 0; k < 3; ++k) {
    const double factor = std::exp((OpenCircuit(problem, at.p) - voc_V) / unit_V);
    at.p[i] = std::min(std::max(at.p[i] * factor, parameter.lower), parameter.upper);
  }
  return at;
}

// The point with the parameter of a refit fixed, as it is or with the open-circuit voltage of the best
// fit, whichever fits better.
FitPoint StartAt(const TwoJunctionProblem& problem, const TwoJunctionModel& model,
                 const ProfileRefit& at, FitPoint from) {
  const double voc_V = OpenCircuit(problem, at.best.p);
  from.p[at.parameter] = at.value;
  FitPoint lowest = from;
  double least = model.MeanSquare(from);
  for (int j = 0; j < 2; ++j) {
    if (at.parameter == JunctionSaturation(j)) continue;
    FitPoint moved = Compensated(model, problem, j, voc_V, from);
    const double mean_square = model.MeanSquare(moved);
    if (!(mean_square < least)) continue;
    least = mean_square;
    lowest = std::move(moved);
  }
  return lowest;
}

// The fit with one parameter fixed. Where the junctions are interchangeable, a refit that ends
// outside the interval may have stopped in a bend of that way: it is tried again from the best
// optimum.
RefineEnd RefitAt(const TwoJunctionProblem& problem, ProfileRefit at, const FitPoint& start) {
  // The way along which the sum of squares stays low is long and bent: steps are short.
  at.how.function_tolerance = at.how.first_tolerance = 1e-2 * at.how.function_tolerance;
  at.how.cutoff = at.best.mean_square + kFarOutside * (at.highest - at.best.mean_square);
  TwoJunctionModel model(problem);
  model.Fix(at.parameter, at.value);
  RefineEnd end = RefineModel(model, StartAt(problem, model, at, start), at.how);
  if (end.mean_square <= at.highest || end.stopped || !problem.ordered) return end;
  RefineEnd again = RefineModel(model, StartAt(problem, model, at, at.best), at.how);
  return again.mean_square < end.mean_square ? again : end;
}

// The best end with the junctions in each other's place, refined.
FitPoint Exchanged(const TwoJunctionProblem& problem, const TwoJunctionModel& model, FitPoint best,
                   const StopToken& stop) {
  std::vector<double>& p = best.p;
  for (int i = 1; i < JunctionPhotocurrent(1); ++i) std::swap(p[i], p[JunctionPhotocurrent(1) + i]);
  if (problem.ordered) p[JunctionPhotocurrent(1)] = 0.01;
  RefineOptions how;
  how.stop = stop;
  return RefineModel(model, std::move(best), how);
}

// Which junctions limit in at least one curve.
std::vector<bool> Limiting(const TwoJunctionProblem& problem, const std::vector<double>& p) {
  std::vector<bool> limits(2, false);
  for (std::size_t c = 0; c < problem.curves.size(); ++c) {
    const auto device = DeviceIn(problem, static_cast<int>(c), p.data());
    limits[device[JunctionPhotocurrent(0)] <= device[JunctionPhotocurrent(1)] ? 0 : 1] = true;
  }
  return limits;
}

// 1 or 2: the junction whose name ends the parameter's symbol; 0: of both.
int JunctionOf(const ParameterInfo& info) {
  const std::string symbol = info.symbol.substr(0, info.symbol.find('['));
  return symbol.back() == '1' ? 1 : symbol.back() == '2' ? 2 : 0;
}

// Symbols of parameters that are not identifiable, by the measurement that decides them.
struct OpenParameters {
  std::string saturation;  // of both junctions
  std::string junction[2];
  std::string common;
};

OpenParameters OpenOf(const std::vector<Estimate>& estimates) {
  OpenParameters open;
  for (const Estimate& e : estimates) {
    if (e.identifiable) continue;
    const int j = JunctionOf(e.info);
    const bool saturation = e.info.kind == ParameterKind::kSaturation;
    std::string& list = saturation ? open.saturation : j > 0 ? open.junction[j - 1] : open.common;
    list += (list.empty() ? "" : ", ") + e.info.symbol;
  }
  return open;
}

std::vector<std::string> Deciding(const TwoJunctionProblem& problem, const std::vector<double>& p,
                                  const std::vector<Estimate>& estimates) {
  const OpenParameters open = OpenOf(estimates);
  std::vector<std::string> sentences;
  if (problem.ordered) {
    sentences.push_back(
        "which junction is the top one: a curve under a second spectrum, with the light of one "
        "junction changed and the lights stated (--light CURVE=TOP:BOTTOM), decides");
  }
  const std::vector<bool> limits = Limiting(problem, p);
  for (int j = 0; j < 2; ++j) {
    if (open.junction[j].empty()) continue;
    sentences.push_back(
        limits[j] ? fmt::format("{}: curves under further spectra, or with less noise, decide",
                                open.junction[j])
                  : fmt::format("{}: a curve under a spectrum with so little light for junction "
                                "{} that it limits the current decides",
                                open.junction[j], j + 1));
  }
  if (!open.saturation.empty()) {
    sentences.push_back(fmt::format(
        "{}: without shunts only n1 ln Is1 + n2 ln Is2 shows, the open-circuit voltage of both; a "
        "curve with light for one junction alone (--light CURVE=1:0), whose open-circuit voltage "
        "is that junction's, decides",
        open.saturation));
  }
  if (!open.common.empty()) {
    sentences.push_back(
        fmt::format("{}: curves at two lights of the same spectrum decide", open.common));
  }
  return sentences;
}

std::vector<TwoJunctionCurveReport> DescribeCurves(const CurveSet& set,
                                                   const PreparedTwoJunctions& prepared,
                                                   const FitPoint& point) {
  std::vector<TwoJunctionCurveReport> curves;
  const std::vector<LightErrors> lights = LightErrorsOf(prepared.problem, point.local);
  const TwoJunctionProblem& problem = prepared.problem;
  for (std::size_t c = 0; c < set.curves.size(); ++c) {
    TwoJunctionCurveReport one;
    one.curve = set.curves[c];
    Forget(About::kCells, &one.curve.assumptions);  // idealities are those of both junctions
    one.light = prepared.light[c];
    one.light_error = lights[c];
    const auto device = DeviceIn(problem, static_cast<int>(c), point.p.data(), lights[c]);
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
    curves.push_back(std::move(one));
  }
  return curves;
}

// Over all readings.
double RmseOf(const std::vector<TwoJunctionCurveReport>& curves) {
  double squares = 0, readings = 0;
  for (const TwoJunctionCurveReport& one : curves) {
    const auto count = static_cast<double>(one.curve.size());
    squares += count * one.rmse_A * one.rmse_A;
    readings += count;
  }
  return std::sqrt(squares / readings);
}

std::vector<std::string> WarningsOf(const CurveSet& set, const EstimateReport& report) {
  std::vector<std::string> warnings;
  if (report.refine.termination == "no convergence") {
    warnings.emplace_back("the polish did not converge");
  }
  if (set.curves.size() > 1) return warnings;
  for (const Assumption& assumption : set.curves.front().assumptions) {
    if (assumption.about != About::kCells) warnings.push_back(assumption.sentence);
  }
  return warnings;
}

// The problem of the estimator.
EstimateProblem ProblemOf(const PreparedTwoJunctions& prepared, const TwoJunctionModel& model,
                          const TwoJunctionOptions& options) {
  const TwoJunctionProblem& junctions = prepared.problem;
  EstimateProblem problem{model,
                          MakeEstimates(junctions.parameters, junctions.lower, junctions.upper)};
  problem.readings = prepared.readings;
  problem.objective = Objective::kSolvedCurrent;
  problem.box = TwoJunctionBox(prepared);
  problem.parameters_at = [&](const double* x) { return ParametersAt(prepared, x); };
  const std::vector<std::vector<double>> shapes = TwoJunctionStarts(prepared);
  for (const std::vector<double>& x : shapes) {
    problem.starts.push_back({"shape", ParametersAt(prepared, x.data())});
  }
  if (options.search.algorithm == Algorithm::kMloShape) problem.box.initial = shapes;
  // Few steps for all starts, more for the better ones, then the best to convergence.
  problem.polish.stages = {{10, 16}, {40, 6}};
  problem.polish.apart = 1e-7;
  problem.polish.visits = 3;
  problem.why_not_usable = [&](const RefineEnd& end) {
    const double misfit = std::sqrt(end.mean_square) / junctions.current_scale_A;
    return misfit <= kMostMisfit
               ? std::string()
               : fmt::format("two junctions miss the readings by {:.2g} % of Isc", 100 * misfit);
  };
  // The share of each junction in the voltage is known through the shunts alone, if at all. All
  // parameters depend on it, and not linearly.
  problem.several_optima = true;
  problem.more_optima = [&](const RefineEnd& best, const StopToken& stop) {
    return std::vector<FitPoint>{Exchanged(junctions, model, best, stop)};
  };
  problem.refit = [&](const ProfileRefit& at, const FitPoint& start) {
    return RefitAt(junctions, at, start);
  };
  if (junctions.light_sd > 0) {
    problem.errors = [&](const RefineEnd& end) { return ErrorsUnderLights(prepared, end); };
  }
  problem.intervals = kTwoJunctionRules;
  problem.restarts = 3;
  return problem;
}

// The fit with uncertain lights from `start`. The course is that of the fit with exact lights.
EstimatedParameters WithLights(const PreparedTwoJunctions& uncertain, EstimatedParameters exact,
                               const RefineEnd& start, const TwoJunctionOptions& options,
                               const ProgressReporter& progress) {
  const TwoJunctionModel model(uncertain.problem);
  RefineOptions how;
  how.stop = progress.stop();
  PolishedParameters polished;
  polished.best = RefineModel(model, start, how);
  polished.course = exact.report.refine;
  std::vector<double> searched;
  for (const Estimate& e : exact.report.estimates) searched.push_back(e.searched);
  EstimatedParameters found =
      JudgeParameters(ProblemOf(uncertain, model, options), polished, searched,
                      {options.search, options.intervals, options.threads}, progress);
  exact.end = std::move(found.end);
  exact.report.estimates = std::move(found.report.estimates);
  exact.report.correlations = std::move(found.report.correlations);
  exact.report.interrupted = exact.report.interrupted || progress.Stopped();
  return exact;
}

}  // namespace

RefineEnd EndOfJunctions(const PreparedTwoJunctions& prepared, const TwoJunctionOptions& options,
                         const Observer& observer) {
  const TwoJunctionModel model(prepared.problem);
  return EstimateParameters(ProblemOf(prepared, model, options),
                            {options.search, Intervals::kNone, options.threads}, observer)
      .end;
}

Expected<TwoJunctionReport> FitTwoJunctions(const CurveSet& set, const TwoJunctionOptions& options,
                                            const Observer& observer) {
  TRY(ValidateAll(options));
  TRY(const PreparedTwoJunctions prepared, PrepareTwoJunctions(set, options));
  const TwoJunctionModel model(prepared.problem);
  EstimatedParameters found =
      EstimateParameters(ProblemOf(prepared, model, options),
                         {options.search, options.intervals, options.threads}, observer);
  PreparedTwoJunctions fitted = prepared;
  TwoJunctionReport report;
  if (!found.end.p.empty() && !found.report.interrupted) {
    report.test = TestJunctions(prepared, found.end);
    const double stated = options.light_accuracy;
    const double rmse_A = std::sqrt(found.end.mean_square);
    if (IsMissed(report.test)) {
      report.exchanged = FindExchangedLights(set, options, prepared, rmse_A, observer);
    }
    constexpr double kUnlikely = 0.05;
    const ProgressReporter progress(observer, 0);
    report.exact_lights_p =
        PValueOfExactLights(prepared, report.test.noise_A, found.end, progress.stop());
    const bool uncertain = std::isnan(stated) ? report.exact_lights_p < kUnlikely : stated > 0;
    if (uncertain && !report.exchanged && report.test.noise_A > 0) {
      const double noise_A = report.test.noise_A;
      fitted = WithUsualLights(prepared, stated, noise_A);
      const RefineEnd start = EndOfJunctions(fitted, options, observer);
      fitted = WithUncertainLights(prepared, stated, noise_A, start, progress.stop());
      found = WithLights(fitted, std::move(found), start, options, progress);
      report.light_part = fitted.problem.light_sd;
      report.test_of_rest = TestJunctions(fitted, found.end);
    }
  }
  static_cast<EstimateReport&>(report) = std::move(found.report);
  report.name = set.name;
  report.constants = options.constants;
  report.temperature_K = set.curves.front().conditions.cell_temperature_K;
  report.interchangeable = prepared.problem.ordered;
  report.non_default_options = NonDefaults(options, kTwoJunctionOptionTable);
  report.estimates = WithOpenEnds(std::move(report.estimates));
  report.decided_by = Deciding(prepared.problem, found.end.p, report.estimates);
  report.curves = DescribeCurves(set, fitted, found.end);
  if (report.light_part > 0) report.rmse.refined.solved_current_A = RmseOf(report.curves);
  report.warnings = WarningsOf(set, report);
  for (std::string& one : TestWarnings(report)) report.warnings.push_back(std::move(one));
  if (report.exchanged && report.usable) {
    report.usable = false;
    report.not_usable_because = fmt::format("the lights of {} and {} look exchanged",
                                            report.exchanged->first, report.exchanged->second);
  }
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
