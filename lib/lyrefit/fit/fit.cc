#include "lyrefit/fit/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "lyrefit/base/parallel.h"
#include "lyrefit/base/version.h"
#include "lyrefit/curve/check_readings.h"
#include "lyrefit/fit/check_birds.h"
#include "lyrefit/fit/diode_order.h"
#include "lyrefit/fit/error_degrees.h"
#include "lyrefit/fit/fit_echo.h"
#include "lyrefit/fit/fit_watch.h"
#include "lyrefit/fit/fixed_values.h"
#include "lyrefit/fit/floor.h"
#include "lyrefit/fit/intervals.h"
#include "lyrefit/fit/polish.h"
#include "lyrefit/fit/polish_extended.h"
#include "lyrefit/fit/reading_errors.h"
#include "lyrefit/fit/robust.h"
#include "lyrefit/fit/search_space.h"
#include "lyrefit/fit/statistics.h"
#include "lyrefit/fit/usable.h"
#include "lyrefit/fit/warnings.h"
#include "lyrefit/fit/weigh.h"
#include "lyrefit/law/current.h"
#include "lyrefit/law/model_points.h"
#include "lyrefit/law/quote.h"
#include "lyrefit/refine/thin.h"

namespace lyrefit {
namespace {

constexpr int kGridStarts = 4;

// What the stages of one fit hand to each other.
struct Job {
  const IvCurve& curve;
  const FitOptions& options;
  const Observer& observer;
  std::vector<ParameterBounds> bounds;
  std::vector<double> fixed;
  int free_parameters = 0;
  RefineProblem problem;
  RefineProblem few;  // the same problem or, of many points, what stands for it in the search
  FitWatch watch;
};

Expected<void> AddEffects(Job* job, FitReport* report) {
  const FitOptions& options = job->options;
  if (options.with.empty()) return {};
  if (options.objective == Objective::kMeasuredCurrent) {
    return Fail(
        "a model with effects is fitted to the solved current: it has no explicit "
        "right-hand side for the measured one");
  }
  if (options.floor) return Fail("a floor is that of diodes alone: leave out the effects or it");
  auto device = Extend(report->device, options.model, options.constants, job->curve, options.with,
                       options.force_effects);
  if (!device) return tl::unexpected(device.error());
  if (auto fine = CheckFitRanges(*device->extension); !fine) return fine;
  report->device = std::move(*device);
  for (const ParameterBounds& bounds : report->device.extension->bounds) {
    job->bounds.push_back(bounds);
    job->fixed.push_back(kUnknown);
  }
  for (const EffectUse& use : options.with) report->causes.push_back(use.effect->id);
  return {};
}

Expected<void> Prepare(Job* job, FitReport* report) {
  const IvCurve& curve = job->curve;
  const FitOptions& options = job->options;
  if (auto valid = Validate(curve); !valid) return valid;
  auto doubts = JudgeReadings(curve);
  if (!doubts) return tl::unexpected(doubts.error());
  report->doubts = std::move(*doubts);
  if (auto valid = ValidateOptions(options.search, kSearchOptionTable); !valid) return valid;
  if (auto valid = ValidateThreads(options.threads); !valid) return valid;
  if (!(options.loss_scale > 0)) return Fail("loss-scale must be above 0");
  if (auto fine = CheckErrorSpec(options); !fine) return fine;
  report->device = MakeDevice(options.model, curve.conditions, options.constants);
  auto bounds = MakeBounds(options.bounds, report->device, curve);
  if (!bounds) return tl::unexpected(bounds.error());
  auto fixed = FixedValues(options.fixed, report->device);
  if (!fixed) return tl::unexpected(fixed.error());
  job->bounds = std::move(*bounds);
  job->fixed = std::move(*fixed);
  if (auto extended = AddEffects(job, report); !extended) return extended;
  std::vector<double> lower, upper;
  for (int i = 0; i < report->device.size(); ++i) {
    ParameterBounds& b = job->bounds[i];
    if (b.lower == b.upper && std::isnan(job->fixed[i])) job->fixed[i] = b.lower;
    const bool is_fixed = !std::isnan(job->fixed[i]);
    if (is_fixed) b = {job->fixed[i], job->fixed[i], job->fixed[i], job->fixed[i], {}};
    job->free_parameters += !is_fixed;
    lower.push_back(b.lower);
    upper.push_back(b.upper);
  }
  const int points = static_cast<int>(curve.size());
  if (points < job->free_parameters) {
    return Fail(
        fmt::format("{} points cannot determine {} parameters: measure more points or fix some",
                    points, job->free_parameters),
        curve.source);
  }
  if (job->free_parameters == 0) return Fail("every parameter is fixed: nothing is left to fit");
  std::vector<double> weights;
  for (const double sigma : curve.sigma_A) weights.push_back(1 / (sigma * sigma));
  job->problem =
      MakeRefineProblem(report->device, options.objective, curve.voltage_V, curve.current_A,
                        std::move(weights), std::move(lower), std::move(upper));
  if (options.kernel != nullptr) job->problem.kernel = options.kernel;
  job->few = Thin(job->problem);
  return {};
}

RmsePair BothRmse(const Device& device, const std::vector<double>& p, const IvCurve& curve) {
  return {Rmse(device, Objective::kMeasuredCurrent, p.data(), curve.voltage_V, curve.current_A),
          Rmse(device, Objective::kSolvedCurrent, p.data(), curve.voltage_V, curve.current_A)};
}

// The best of as many random points as the search evaluated.
void RunRandomBaseline(Job* job, const SearchSpace& space, const ObjectiveFunction& objective,
                       FitReport* report) {
  SearchOptions random = job->options.search;
  random.algorithm = Algorithm::kRandom;
  random.max_evaluations = std::max<std::int64_t>(report->search.evaluations, 4);
  random.target = -kInfinity;
  random.patience = 0;
  const SearchSummary baseline = Search(objective, space.box(), random, job->observer);
  if (baseline.termination == SearchTermination::kInterrupted) job->watch.MarkStopped();
  std::vector<double> p(report->device.size());
  space.ToParameters(baseline.best.x.data(), p.data());
  report->rmse.random_baseline = BothRmse(report->device, p, job->curve);
}

// Runs the search; returns the elites as parameter vectors.
Expected<std::vector<std::vector<double>>> RunSearch(Job* job, FitReport* report) {
  const SearchSpace space(job->bounds, job->fixed);
  std::vector<double> p(report->device.size());
  const auto rmse_of = [&](const RefineProblem& problem) -> ObjectiveFunction {
    return [&](const double* x) {
      space.ToParameters(x, p.data());
      return std::sqrt(MeanSquare(problem, p));
    };
  };
  const ObjectiveFunction objective = rmse_of(job->few);
  const SearchFunction& searcher = job->options.searcher;
  report->search = searcher ? searcher(objective, space.box(), job->options.search, job->observer)
                            : Search(objective, space.box(), job->options.search, job->observer);
  if (searcher || job->few.points.size < job->problem.points.size) {
    const auto valid = CheckBirds(rmse_of(job->problem), space.box(), &report->search);
    if (!valid) return tl::unexpected(valid.error());
  }
  if (report->search.termination == SearchTermination::kInterrupted) job->watch.MarkStopped();
  const bool is_random = job->options.search.algorithm == Algorithm::kRandom;
  if (job->options.random_baseline && !is_random && !job->watch.stopped()) {
    RunRandomBaseline(job, space, objective, report);
  }
  std::vector<std::vector<double>> elites;
  for (const Bird& bird : report->search.elites) {
    space.ToParameters(bird.x.data(), p.data());
    elites.push_back(p);
  }
  return elites;
}

// Bounds of parameter i in the units of reports, where the others are as at `p`.
ParameterBounds ReportedBounds(const Device& device, const ParameterBounds& own,
                               std::vector<double> p, int i) {
  if (device.extension == nullptr || i < device.extension->law.base_size()) return own;
  const auto reported = [&](double value) {
    p[i] = value;
    return Reported(device, p)[i];
  };
  const std::pair<double, double> ends = std::minmax({reported(own.lower), reported(own.upper)});
  const auto& [lower, upper] = ends;
  return {lower, upper, lower, upper, own.scale};
}

// All in the units of reports.
void FillEstimates(const Job& job, const FitReport& report, std::vector<Estimate>* estimates) {
  const Device& device = report.device;
  const std::vector<double> searched = Reported(device, report.searched);
  const std::vector<double> refined = Reported(device, report.refined);
  estimates->clear();
  for (int i = 0; i < device.size(); ++i) {
    Estimate e;
    e.info = device.parameters[i];
    e.bounds = ReportedBounds(device, job.bounds[i], report.refined, i);
    e.fixed = !std::isnan(job.fixed[i]);
    e.searched = searched[i];
    if (report.polished) e.refined = refined[i];
    estimates->push_back(std::move(e));
  }
}

// Everything that follows from the parameters.
void FillResults(const Job& job, FitReport* report) {
  const IvCurve& curve = job.curve;
  const Device& device = report->device;
  report->rmse.searched = BothRmse(device, report->searched, curve);
  if (report->polished) {
    report->rmse.best_bird_polished = BothRmse(device, report->best_bird_polished, curve);
    report->rmse.refined = BothRmse(device, report->refined, curve);
  }
  const std::vector<double>& p = report->refined;
  report->nNsVth = p[IdealityIndex(0)] * device.module_thermal_voltage_V;
  report->measured = FindKeyPoints(curve.voltage_V, curve.current_A);
  report->simulated = ModelKeyPoints(device, p.data());
  report->model_current_A =
      SolveCurrents(device, p.data(), job.problem.points, *job.problem.kernel);
  report->residual_A.clear();
  for (std::size_t k = 0; k < curve.size(); ++k) {
    report->residual_A.push_back(report->model_current_A[k] - curve.current_A[k]);
  }
  const RefineProblem& problem = job.problem;
  const double mean_square =
      MeanSquare(device, problem.objective, p.data(), problem.points, *problem.kernel);
  report->criteria =
      FindInformation(mean_square, static_cast<int>(curve.size()), job.free_parameters);
  report->residuals = FindResidualStatistics(curve.voltage_V, report->residual_A);
  report->not_usable_because =
      WhyNotUsable(*report, job.watch.stopped(), job.options.loss != Loss::kSquared);
  report->usable = report->not_usable_because.empty();
}

// How far the answer lies above what any number of diodes could reach.
void FindFloor(Job* job, FitReport* report) {
  if (!job->options.floor || job->watch.Stop()) return;
  const CertifyOptions options = RangesOf(job->bounds, job->options.constants, {});
  const Expected<Certificate> certificate = Certify(job->curve, options, job->observer);
  if (!certificate) {
    report->warnings.push_back("No floor was found: " + certificate.error().message + ".");
    return;
  }
  FloorReport floor;
  floor.rmse_A = certificate->floor.rmse_A;
  floor.lower_bound_A = certificate->floor.lower_bound_A;
  floor.n_lower = options.n_lower;
  floor.n_upper = options.n_upper;
  floor.above = BothRmse(report->device, report->refined, job->curve).measured_current_A /
                    certificate->floor.rmse_A -
                1;
  report->floor = floor;
  if (certificate->interrupted) job->watch.MarkStopped();
}

// Takes `better` as the end of the polish.
void StartOver(const RefineProblem& problem, const RefineEnd& end,
               const std::vector<double>& better, RefineReport* report) {
  for (StartReport& start : report->starts) start.agrees = false;
  report->starts.push_back(
      {"profile", std::sqrt(MeanSquare(problem, better)), std::sqrt(end.mean_square), true});
  report->winner = static_cast<int>(report->starts.size()) - 1;
  report->agreeing = 1;
}

// Intervals around `end`, and from a lower optimum once more if a profile comes upon one.
void JudgeAndImprove(Job* job, const RefineProblem& problem, const std::vector<FitPoint>& ends,
                     const std::vector<int>& degrees, RefineEnd* end, FitReport* report) {
  const FitOptions& options = job->options;
  const bool wanted = report->no_intervals_because.empty();
  // Of many readings that hang together and are not averaged, profiles would take minutes.
  constexpr std::size_t kMostProfiled = 2000;
  const bool many = problem.errors != nullptr && problem.voltage_V.size() > kMostProfiled;
  const Intervals method =
      many && options.intervals == Intervals::kProfile ? Intervals::kSymmetric : options.intervals;
  constexpr int kRestarts = 3;
  for (int round = 0; round <= kRestarts; ++round) {
    OrderDiodes(report->device, job->bounds, &end->p, &end->held);
    report->refined = end->p;
    FillEstimates(*job, *report, &report->estimates);
    report->correlations.clear();
    const IntervalInput input{problem,
                              *end,
                              ends,
                              wanted ? method : Intervals::kNone,
                              job->free_parameters,
                              options.threads,
                              &job->watch,
                              round == kRestarts,
                              nullptr,
                              degrees};
    const std::vector<double> better =
        FindIntervals(input, &report->estimates, &report->correlations, &report->refine.condition);
    if (better.empty() || round == kRestarts) break;
    RefineOptions how;
    how.stop = job->watch.stop();
    *end = Refine(problem, better, how);
    StartOver(problem, *end, better, &report->refine);
  }
}

int SpareReadings(const Job& job) {
  return std::max(static_cast<int>(job.curve.size()) - job.free_parameters, 1);
}

// What the errors of a plain fit are, and intervals under them where they are believed.
void FindIntervalsUnderErrors(Job* job, const std::vector<FitPoint>& ends, const RefineEnd& end,
                              FitReport* report) {
  constexpr double kLeastGain = 6;  // independent errors would reach it in some 3 % of all curves
  const bool possible = job->options.loss == Loss::kSquared && report->no_intervals_because.empty();
  if (job->options.intervals == Intervals::kNone || !possible || job->watch.stopped()) return;
  const std::optional<FoundErrors> found = FindErrors(job->problem, job->curve, end);
  if (!found) return;
  ErrorReport errors;
  errors.sizes = found->sizes;
  errors.gain = found->gain;
  errors.current_stated = !job->curve.sigma_A.empty();
  errors.believed = found->gain > kLeastGain;
  report->errors = errors;
  if (!errors.believed) return;
  const ErrorShape shape = ShapeOfErrors(job->problem, job->curve, end.p);
  const auto input_under = [&](const ErrorModel& model) {
    return IntervalInput{job->problem,
                         end,
                         ends,
                         job->options.intervals,
                         job->free_parameters,
                         job->options.threads,
                         &job->watch,
                         true,
                         &model};
  };
  const auto errors_at = [&](const ErrorSizes& sizes) {
    return StandardErrors(input_under(MakeErrorModel(shape, sizes)));
  };
  const ErrorModel model = MakeErrorModel(shape, found->sizes);
  IntervalInput input = input_under(model);
  input.degrees = FindDegrees(*found, errors_at, SpareReadings(*job));
  FillEstimates(*job, *report, &report->under_errors);
  std::vector<Correlation> correlations;
  double condition = 0;
  FindIntervals(input, &report->under_errors, &correlations, &condition);
}

// Of the standard errors of a fit that was weighed by found errors.
std::vector<int> DegreesOfWeighed(Job* job, const FoundErrors& found, const RefineEnd& end) {
  const auto errors_at = [&](const ErrorSizes& sizes) {
    const ErrorSpec spec = {ErrorKind::kField, sizes, "field"};
    const RefineProblem there = WeighByErrors(job->problem, job->curve, spec, end.p);
    return StandardErrors({there,
                           end,
                           {},
                           Intervals::kSymmetric,
                           job->free_parameters,
                           job->options.threads,
                           &job->watch});
  };
  return FindDegrees(found, errors_at, SpareReadings(*job));
}

// Polishes, finds intervals around what is usable, and says where the polish ended.
void PolishAndJudge(Job* job, const std::vector<std::vector<double>>& elites, FitReport* report) {
  const FitOptions& options = job->options;
  const bool extended = report->device.extension != nullptr;
  const auto starts = extended ? CollectExtendedStarts(job->problem, elites)
                               : CollectStarts(job->few, elites, kGridStarts);
  PolishResult polish = extended ? PolishExtended(job->problem, starts, &job->watch)
                                 : PolishStarts(job->problem, job->few, starts, &job->watch);
  report->polished = true;
  report->refine = polish.report;
  report->best_bird_polished = polish.first.p;
  OrderDiodes(report->device, job->bounds, &report->best_bird_polished, nullptr);
  RefineEnd end = polish.best;
  if (options.loss != Loss::kSquared) Robustify(options, job->watch.stop(), &job->problem, &end);

  RefineProblem problem = job->problem;
  std::vector<int> degrees;
  if (options.errors.kind != ErrorKind::kWhite) {
    const RmsePair least_squares = BothRmse(report->device, end.p, job->curve);
    const auto weighed = WeighAndRefine(options.errors, job->curve, &job->watch, &problem, &end);
    if (weighed) {
      report->errors = weighed->errors;
      report->errors->least_squares = least_squares;
    }
    if (weighed && weighed->found) degrees = DegreesOfWeighed(job, *weighed->found, end);
  }
  OrderDiodes(report->device, job->bounds, &end.p, &end.held);
  const std::vector<double> polished = report->refined = end.p;
  FillResults(*job, report);
  if (!report->usable && options.intervals != Intervals::kNone) {
    report->no_intervals_because =
        "the fit is not usable: around parameters of a curve that the model does not describe no "
        "interval means anything";
  }
  const auto begin = std::chrono::steady_clock::now();
  for (FitPoint& other : polish.ends) OrderDiodes(report->device, job->bounds, &other.p, nullptr);
  JudgeAndImprove(job, problem, polish.ends, degrees, &end, report);
  if (!report->errors) FindIntervalsUnderErrors(job, polish.ends, end, report);
  if (report->refined != polished) FillResults(*job, report);
  report->refine.projected_gradient = end.projected_gradient;
  report->interval_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

Expected<FitReport> Fit(const IvCurve& curve, const FitOptions& options, const Observer& observer) {
  FitReport report;
  Job job{curve, options, observer, {}, {}, 0, {}, {}, FitWatch(observer)};
  if (auto ready = Prepare(&job, &report); !ready) return tl::unexpected(ready.error());
  report.version = Version();
  report.curve = curve;
  report.model = options.model;
  report.objective = options.objective;
  report.constants = options.constants;
  report.bounds_name = options.bounds.name;
  report.search_options = options.search;
  EchoOptions(options, &report);

  auto searched = RunSearch(&job, &report);
  if (!searched) return tl::unexpected(searched.error());
  const std::vector<std::vector<double>>& elites = *searched;
  report.searched = report.refined = elites[0];
  OrderDiodes(report.device, job.bounds, &report.searched, nullptr);
  if (options.plain_polish) {
    const RefineEnd plain = RefinePlainly(job.problem, elites[0]);
    report.rmse.plain_polished = BothRmse(report.device, plain.p, curve);
  }
  if (options.polish) {
    PolishAndJudge(&job, elites, &report);
  } else {
    report.refined = report.searched;
    FillEstimates(job, report, &report.estimates);
    FillResults(job, &report);
  }
  report.interrupted = job.watch.stopped();
  report.warnings = FindWarnings(report);
  FindFloor(&job, &report);
  report.interrupted = job.watch.stopped();
  return report;
}

}  // namespace lyrefit
