#include "lyrefit/fit/fit_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/parallel.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/check_readings.h"
#include "lyrefit/fit/distinct_readings.h"
#include "lyrefit/fit/fixed_values.h"
#include "lyrefit/fit/reading_errors.h"
#include "lyrefit/fit/variant_problem.h"
#include "lyrefit/law/current.h"
#include "lyrefit/law/quote.h"
#include "lyrefit/law/term.h"
#include "lyrefit/refine/coarsen.h"

namespace lyrefit {

Expected<void> CheckObjectiveOfEffects(Objective objective) {
  if (objective == Objective::kSolvedCurrent) return {};
  return Fail(
      "a model with effects is fitted to the solved current: it has no explicit "
      "right-hand side for the measured one");
}

namespace {

Expected<void> AddEffects(FitJob* job, FitReport* report) {
  const FitOptions& options = job->options;
  if (options.with.empty()) return {};
  TRY(CheckObjectiveOfEffects(options.objective));
  if (options.floor) return Fail("a floor is that of diodes alone: leave out the effects or it");
  TRY(auto device, Extend(report->device, options.model, options.constants, job->curve,
                          options.with, options.force_effects));
  TRY(CheckFitRanges(*device.effects));
  report->device = std::move(device);
  job->variants = VariantsOf(*report->device.effects);
  // The variant with most free parameters needs the most points.
  const Variant& freest =
      *std::max_element(job->variants.begin(), job->variants.end(),
                        [](const Variant& a, const Variant& b) { return a.free < b.free; });
  for (const ParameterBounds& bounds : freest.bounds) {
    job->bounds.push_back(bounds);
    job->fixed.push_back(kUnknown);
  }
  for (const EffectUse& use : options.with) report->causes.push_back(use.effect->id);
  return {};
}

// Bounds of parameter i in reporting units, with the other parameters at `p`.
ParameterBounds ReportedBounds(const Device& device, const ParameterBounds& own,
                               std::vector<double> p, int i) {
  if (device.effects == nullptr || i < device.effects->law.base_size()) return own;
  const auto reported = [&](double value) {
    p[i] = value;
    return Reported(device, p)[i];
  };
  const std::pair<double, double> ends = std::minmax({reported(own.lower), reported(own.upper)});
  const auto& [lower, upper] = ends;
  return {lower, upper, lower, upper, own.scale, own.whole};
}

// Error for options that do not support weighting by an error model.
Expected<void> CheckErrorSpec(const FitOptions& options) {
  if (options.errors.kind == ErrorKind::kWhite) return {};
  if (options.objective == Objective::kMeasuredCurrent) {
    return Fail(
        "noise weighs the solved current alone: the errors of a reading stand on both sides of the "
        "measured-current equation");
  }
  if (options.loss != Loss::kSquared) return Fail("noise weighs squared residuals: leave out loss");
  if (!options.polish) return Fail("noise weighs the polish, which is switched off");
  return {};
}

// Smallest n at which no exponent is cut off (law/term.h), at any reading and any Rs in its range.
double SteepestIdeality(const IvCurve& curve, const Device& device, const ParameterBounds& rs) {
  double voltage = 0, current = 0;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    voltage = std::max(voltage, curve.voltage_V[k]);
    current = std::max(current, std::fabs(curve.current_A[k]));
  }
  const double most = current > 0 ? std::min(rs.upper, voltage / current) : rs.upper;
  double junction_V = 0;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    for (const double r : {rs.lower, most}) {
      junction_V = std::max(junction_V, curve.voltage_V[k] + r * curve.current_A[k]);
    }
  }
  return junction_V / (kLargestExponent * device.module_thermal_voltage_V);
}

// Raises the lower bounds of n to the smallest value without a cut-off. A diode whose exponent is
// cut off is a step in the current, which could fit any data and is no diode.
void LeaveOutSteps(FitJob* job, FitReport* report) {
  const double steepest = SteepestIdeality(job->curve, report->device, job->bounds[kRs]);
  for (int d = 0; d < DiodeCount(report->device); ++d) {
    ParameterBounds& n = job->bounds[IdealityIndex(d)];
    if (!(n.lower < steepest && steepest < n.upper)) continue;
    if (!std::isnan(job->fixed[IdealityIndex(d)])) continue;
    report->steepest_n = n.lower = steepest;
    n.search_lower = std::max(n.search_lower, steepest);
    n.search_upper = std::max(n.search_upper, steepest);
  }
}

}  // namespace

Expected<void> PrepareFit(FitJob* job, FitReport* report) {
  const IvCurve& curve = job->curve;
  const FitOptions& options = job->options;
  TRY(Validate(curve));
  TRY(report->doubts, JudgeReadings(curve));
  TRY(ValidateOptions(options.search, kSearchOptionTable));
  TRY(ValidateThreads(options.threads));
  if (!(options.loss_scale > 0)) return Fail("loss-scale must be above 0");
  TRY(CheckErrorSpec(options));
  report->device = MakeDevice(options.model, curve.conditions, options.constants);
  TRY(auto bounds, MakeBounds(options.bounds, report->device, curve));
  TRY(auto fixed, FixedValues(options.fixed, report->device));
  job->bounds = std::move(bounds);
  job->fixed = std::move(fixed);
  LeaveOutSteps(job, report);
  TRY(AddEffects(job, report));
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
  DistinctReadings distinct = FindDistinctReadings(curve);
  job->distinct = std::move(distinct.curve);
  if (job->readings() < job->free_parameters) {
    return Fail(
        fmt::format("{} {}points cannot determine {} parameters: measure more points or fix some",
                    job->readings(), distinct.copies.empty() ? "" : "different ",
                    job->free_parameters),
        curve.source);
  }
  if (job->free_parameters == 0) return Fail("every parameter is fixed: nothing is left to fit");
  // Effects refer to readings by their index in the curve, so duplicates stay.
  const IvCurve& fitted = job->fitted();
  std::vector<double> weights;
  for (const double sigma : fitted.sigma_A) weights.push_back(1 / (sigma * sigma));
  if (job->variants.empty() && !distinct.copies.empty()) {
    weights.resize(fitted.size(), 1.0);
    for (std::size_t k = 0; k < weights.size(); ++k) weights[k] *= distinct.copies[k];
  }
  job->problem =
      MakeRefineProblem(report->device, options.objective, fitted.voltage_V, fitted.current_A,
                        std::move(weights), std::move(lower), std::move(upper));
  if (options.kernel != nullptr) job->problem.kernel = options.kernel;
  job->coarse = Coarsen(job->problem);
  return {};
}

SearchSpace SpaceOf(const FitJob& job) {
  if (job.variants.empty()) return {job.bounds, job.fixed};
  const int base = job.base_size();
  return {{job.bounds.begin(), job.bounds.begin() + base},
          {job.fixed.begin(), job.fixed.begin() + base},
          *job.problem.device.effects,
          job.variants};
}

double VariantPenaltyOf(const FitJob& job, int variant) {
  const double price = VariantPenalty(job.problem, job.variants[variant]);
  double lowest = price;
  for (const Variant& other : job.variants)
    lowest = std::min(lowest, VariantPenalty(job.problem, other));
  return price / lowest;
}

void SelectVariant(int variant, const std::vector<double>& p, FitJob* job, FitReport* report) {
  const Variant& own = job->variants[variant];
  const int first = job->base_size();
  job->problem = InVariant(job->problem, own, p);
  auto device_effects = std::make_shared<DeviceEffects>(*report->device.effects);
  for (int k = 0; k < job->effects(); ++k) {
    const ParameterBounds& bounds = own.bounds[k];
    const bool held = bounds.lower == bounds.upper;
    job->bounds[first + k] = bounds;
    job->fixed[first + k] = held ? bounds.lower : kUnknown;
    // A selected integer parameter is fixed from here on.
    const double at = p[first + k];
    device_effects->bounds[k] = bounds.whole > 0 ? ParameterBounds{at, at, at, at, {}, 0} : bounds;
  }
  device_effects->usual = own.usual;
  job->free_parameters = own.free;
  for (int i = 0; i < first; ++i) job->free_parameters += std::isnan(job->fixed[i]) ? 1 : 0;
  report->variant_penalty = VariantPenaltyOf(*job, variant);
  report->device.effects = std::move(device_effects);
  job->problem.device = report->device;
  job->coarse = Coarsen(job->problem);
}

RmsePair BothRmse(const Device& device, const std::vector<double>& p, const IvCurve& curve) {
  return {Rmse(device, Objective::kMeasuredCurrent, p.data(), curve.voltage_V, curve.current_A),
          Rmse(device, Objective::kSolvedCurrent, p.data(), curve.voltage_V, curve.current_A)};
}

std::vector<Estimate> EstimatesOf(const FitJob& job, const FitReport& report) {
  const Device& device = report.device;
  const std::vector<double> searched = Reported(device, report.searched);
  const std::vector<double> refined = Reported(device, report.refined);
  std::vector<Estimate> estimates;
  for (int i = 0; i < device.size(); ++i) {
    Estimate e;
    e.info = device.parameters[i];
    e.bounds = ReportedBounds(device, job.bounds[i], report.refined, i);
    e.fixed = !std::isnan(job.fixed[i]);
    e.searched = searched[i];
    if (report.polished) e.refined = refined[i];
    estimates.push_back(std::move(e));
  }
  return estimates;
}

}  // namespace lyrefit
