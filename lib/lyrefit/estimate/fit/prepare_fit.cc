#include "lyrefit/estimate/fit/prepare_fit.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <tuple>

#include "lyrefit/base/parallel.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/beyond_voc.h"
#include "lyrefit/curve/check_readings.h"
#include "lyrefit/estimate/fit/usable.h"
#include "lyrefit/estimate/refine/coarsen.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/model/reporting_units.h"

namespace lyrefit {

DistinctReadings FindDistinctReadings(const IvCurve& curve) {
  const auto at = [](const std::vector<double>& column, int k) {
    return column.empty() ? 0 : column[k];
  };
  const auto key = [&](int k) {
    return std::make_tuple(curve.voltage_V[k], curve.current_A[k], at(curve.sigma_A, k),
                           at(curve.time_s, k));
  };
  const int readings = static_cast<int>(curve.size());
  std::vector<int> order(readings);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  std::vector<double> copies(readings, 0);
  int first = 0, distinct = 0;
  for (int k = 0; k < readings; ++k) {
    if (k == 0 || key(order[k]) != key(first)) {
      first = order[k];
      ++distinct;
    }
    ++copies[first];
  }
  DistinctReadings found{curve, {}};
  if (distinct == readings) return found;
  std::vector<int> kept;
  for (int k = 0; k < readings; ++k) {
    if (copies[k] > 0) kept.push_back(k);
  }
  KeepValues(kept, &copies);
  found.copies = std::move(copies);
  KeepReadings(kept, &found.curve);
  return found;
}

RefineProblem InVariant(const RefineProblem& problem, const Variant& variant,
                        const std::vector<double>& p) {
  RefineProblem own = problem;
  const std::size_t first = p.size() - variant.bounds.size();
  for (std::size_t k = 0; k < variant.bounds.size(); ++k) {
    const ParameterBounds& bounds = variant.bounds[k];
    const bool whole = bounds.whole > 0;
    own.lower[first + k] = whole ? p[first + k] : bounds.lower;
    own.upper[first + k] = whole ? p[first + k] : bounds.upper;
  }
  return own;
}

double VariantPenalty(const RefineProblem& problem, const Variant& variant) {
  const double points = static_cast<double>(problem.voltage_V.size());
  return std::exp(0.5 * variant.free * std::log(points) / points);
}

Expected<void> CheckObjectiveOfEffects(Objective objective) {
  if (objective == Objective::kSolvedCurrent) return {};
  return Fail(
      "a model with effects is fitted to the solved current: it has no explicit "
      "right-hand side for the measured one");
}

namespace {

Expected<void> AddEffects(PreparedFit* fit) {
  const FitOptions& options = fit->options;
  if (options.with.empty()) return {};
  TRY(CheckObjectiveOfEffects(options.objective));
  if (options.floor) return Fail("a floor is that of diodes alone: leave out the effects or it");
  TRY(fit->device, Extend(fit->device, options.model, options.constants, fit->curve, options.with,
                          options.force_effects));
  TRY(CheckFitRanges(*fit->device.effects));
  fit->variants = VariantsOf(*fit->device.effects);
  // The variant with most free parameters needs the most points.
  const Variant& freest =
      *std::max_element(fit->variants.begin(), fit->variants.end(),
                        [](const Variant& a, const Variant& b) { return a.free < b.free; });
  for (const ParameterBounds& bounds : freest.bounds) {
    fit->bounds.push_back(bounds);
    fit->fixed.push_back(kUnknown);
  }
  return {};
}

// Value of each parameter that the user fixed, NaN for the others. Keys are symbols or names; "Is"
// and "n" stand for every diode.
Expected<std::vector<double>> FixedValues(const std::map<std::string, double>& fixed,
                                          const Device& device) {
  std::vector<double> values(device.size(), kUnknown);
  for (const auto& [key, value] : fixed) {
    bool known = false;
    for (int i = 0; i < device.size(); ++i) {
      const ParameterInfo& info = device.parameters[i];
      const bool group = (key == "Is" && info.kind == ParameterKind::kSaturation) ||
                         (key == "n" && info.kind == ParameterKind::kIdeality);
      if (!group && info.symbol != key && info.name != key) continue;
      const bool must_be_positive =
          info.kind == ParameterKind::kIdeality || info.kind == ParameterKind::kShunt;
      if (!std::isfinite(value) || value < 0 || (must_be_positive && value <= 0)) {
        return Fail(fmt::format("{} cannot be fixed at {:g}, expected a finite number {}", key,
                                value, must_be_positive ? "above 0" : "of 0 or more"));
      }
      values[i] = value;
      known = true;
    }
    if (!known) return Fail(fmt::format("cannot fix '{}': this model has no such parameter", key));
  }
  return values;
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

Expected<void> CheckOptions(const FitOptions& options) {
  TRY(ValidateOptions(options, kFitOptionTable));
  TRY(ValidateOptions(options.search, kSearchOptionTable));
  TRY(ValidateThreads(options.threads));
  if (!(options.loss_scale > 0)) return Fail("loss-scale must be above 0");
  return CheckErrorSpec(options);
}

// Fixes parameters whose bounds coincide, and counts the free ones.
void CountFree(PreparedFit* fit) {
  for (int i = 0; i < fit->device.size(); ++i) {
    ParameterBounds& b = fit->bounds[i];
    if (b.lower == b.upper && std::isnan(fit->fixed[i])) fit->fixed[i] = b.lower;
    const bool is_fixed = !std::isnan(fit->fixed[i]);
    if (is_fixed) b = {fit->fixed[i], fit->fixed[i], fit->fixed[i], fit->fixed[i], {}};
    fit->free_parameters += !is_fixed;
  }
}

// The least-squares problem of the fitted readings. `copies`: number of equal readings of each
// distinct one; empty: all differ.
RefineProblem ProblemOf(const PreparedFit& fit, const std::vector<double>& copies) {
  // Effects refer to readings by their index in the curve, so duplicates stay.
  const IvCurve& fitted = fit.fitted();
  std::vector<double> weights;
  for (const double sigma : fitted.sigma_A) weights.push_back(1 / (sigma * sigma));
  if (!fit.extended() && !copies.empty()) {
    weights.resize(fitted.size(), 1.0);
    for (std::size_t k = 0; k < weights.size(); ++k) weights[k] *= copies[k];
  }
  std::vector<double> lower, upper;
  for (const ParameterBounds& b : fit.bounds) {
    lower.push_back(b.lower);
    upper.push_back(b.upper);
  }
  RefineProblem problem =
      MakeRefineProblem(fit.device, fit.options.objective, fitted.voltage_V, fitted.current_A,
                        std::move(weights), std::move(lower), std::move(upper));
  if (fit.options.kernel != nullptr) problem.kernel = fit.options.kernel;
  return problem;
}

}  // namespace

Expected<PreparedFit> PrepareFit(const IvCurve& given, const FitOptions& options) {
  TRY(Validate(given));
  PreparedFit fit{WithoutBeyondVoc(given), options};
  const IvCurve& curve = fit.curve;
  TRY(fit.doubts, JudgeReadings(curve));
  TRY(CheckOptions(options));
  fit.device = MakeDevice(options.model, curve.conditions, options.constants);
  TRY(fit.bounds, MakeBounds(options.bounds, fit.device, curve));
  TRY(fit.fixed, FixedValues(options.fixed, fit.device));
  fit.steepest_n = LeaveOutSteps(fit.curve, fit.device, fit.fixed, &fit.bounds);
  TRY(AddEffects(&fit));
  CountFree(&fit);
  DistinctReadings distinct = FindDistinctReadings(curve);
  fit.distinct = std::move(distinct.curve);
  if (fit.readings() < fit.free_parameters) {
    return Fail(
        fmt::format("{} {}points cannot determine {} parameters: measure more points or fix some",
                    fit.readings(), distinct.copies.empty() ? "" : "different ",
                    fit.free_parameters),
        curve.source);
  }
  if (fit.free_parameters == 0) return Fail("every parameter is fixed: nothing is left to fit");
  fit.problem = ProblemOf(fit, distinct.copies);
  fit.coarse = Coarsen(fit.problem);
  return fit;
}

SearchSpace SpaceOf(const PreparedFit& fit) {
  const int base = fit.base_size();
  SearchSpace space = fit.extended() ? SearchSpace({fit.bounds.begin(), fit.bounds.begin() + base},
                                                   {fit.fixed.begin(), fit.fixed.begin() + base},
                                                   *fit.device.effects, fit.variants)
                                     : SearchSpace(fit.bounds, fit.fixed);
  space.NameSides(fit.device.parameters);
  return space;
}

double VariantPenaltyOf(const PreparedFit& fit, int variant) {
  const double penalty = VariantPenalty(fit.problem, fit.variants[variant]);
  double lowest = penalty;
  for (const Variant& other : fit.variants)
    lowest = std::min(lowest, VariantPenalty(fit.problem, other));
  return penalty / lowest;
}

PreparedFit WithVariant(PreparedFit fit, int variant, const std::vector<double>& p) {
  const Variant& own = fit.variants[variant];
  const int first = fit.base_size();
  fit.problem = InVariant(fit.problem, own, p);
  auto device_effects = std::make_shared<DeviceEffects>(*fit.device.effects);
  for (int k = 0; k < fit.effects_size(); ++k) {
    const ParameterBounds& bounds = own.bounds[k];
    const bool is_fixed = bounds.lower == bounds.upper;
    fit.bounds[first + k] = bounds;
    fit.fixed[first + k] = is_fixed ? bounds.lower : kUnknown;
    // A selected integer parameter is fixed from here on.
    const double at = p[first + k];
    device_effects->bounds[k] = bounds.whole > 0 ? ParameterBounds{at, at, at, at, {}, 0} : bounds;
  }
  device_effects->usual = own.usual;
  fit.free_parameters = own.free;
  for (int i = 0; i < first; ++i) fit.free_parameters += std::isnan(fit.fixed[i]) ? 1 : 0;
  fit.variant_penalty = VariantPenaltyOf(fit, variant);
  fit.device.effects = std::move(device_effects);
  fit.problem.device = fit.device;
  fit.coarse = Coarsen(fit.problem);
  return fit;
}

RmsePair BothRmse(const Device& device, const std::vector<double>& p, const IvCurve& curve) {
  return {Rmse(device, Objective::kMeasuredCurrent, p.data(), curve.voltage_V, curve.current_A),
          Rmse(device, Objective::kSolvedCurrent, p.data(), curve.voltage_V, curve.current_A)};
}

std::vector<Estimate> EstimatesOf(const PreparedFit& fit, const std::vector<double>& searched,
                                  const std::vector<double>& refined) {
  const Device& device = fit.device;
  const std::vector<double>& best = refined.empty() ? searched : refined;
  const std::vector<double> of_search = Reported(device, searched),
                            of_best = Reported(device, best);
  std::vector<Estimate> estimates;
  for (int i = 0; i < device.size(); ++i) {
    Estimate e;
    e.info = device.parameters[i];
    e.bounds = ReportedBounds(SpanOf(device), fit.bounds[i], best, i);
    e.fixed = !std::isnan(fit.fixed[i]);
    e.searched = of_search[i];
    if (!refined.empty()) e.refined = of_best[i];
    estimates.push_back(std::move(e));
  }
  return estimates;
}

}  // namespace lyrefit
