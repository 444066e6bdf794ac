#include "lyrefit/certify/floor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/try.h"
#include "lyrefit/certify/certify.h"
#include "lyrefit/curve/beyond_voc.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/model/device.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {
namespace {

constexpr double kLeastSaturation_A = 1e-300;

// Limits for the solved current. A proof that reaches the tolerance does so within this number of
// problems; the time of each is proportional to the number of readings.
constexpr double kSolvedTolerance = 1e-6;
constexpr std::int64_t kSolvedEffort = 1500;
constexpr std::size_t kMostReadings = 2000;

bool HasOwnRanges(const CertifyOptions& options) {
  const CertifyOptions usual;
  return options.n_lower != usual.n_lower || options.n_upper != usual.n_upper ||
         options.rs_lower_ohm != usual.rs_lower_ohm || options.rs_upper_ohm != usual.rs_upper_ohm ||
         options.iph_lower_A != usual.iph_lower_A || options.iph_upper_A != usual.iph_upper_A ||
         options.is_lower_A != usual.is_lower_A || options.is_upper_A != usual.is_upper_A ||
         options.rsh_lower_ohm != usual.rsh_lower_ohm ||
         options.rsh_upper_ohm != usual.rsh_upper_ohm || !options.diodes.empty();
}

// Proves the floor within `ranges`, below a fit within them that has the RMSE `refined_A` in the
// same objective. Sets `interrupted` if the observer stopped the proof.
Expected<FloorReport> ProveFloor(const IvCurve& curve, CertifyOptions ranges, double refined_A,
                                 const Observer& observer, bool* interrupted) {
  if (ranges.objective == Objective::kSolvedCurrent) {
    if (curve.size() > kMostReadings) {
      return Fail(
          fmt::format("of the solved current it takes too long for {} readings, more than {}",
                      curve.size(), kMostReadings));
    }
    ranges.tolerance = kSolvedTolerance;
    ranges.effort = kSolvedEffort;
  }
  TRY(const Certificate certificate, Certify(curve, ranges, observer));
  *interrupted = certificate.interrupted;
  FloorReport floor;
  floor.objective = ranges.objective;
  floor.rmse_A = std::min(certificate.floor.rmse_A, refined_A);
  floor.lower_bound_A = std::min(certificate.floor.lower_bound_A, floor.rmse_A);
  floor.n_lower = ranges.n_lower;
  floor.n_upper = ranges.n_upper;
  double largest_A = 0;
  for (const double current : curve.current_A) {
    largest_A = std::max(largest_A, std::fabs(current));
  }
  const double rounding_A = kCertifiedRounding * largest_A;
  const double excess_A = refined_A - floor.rmse_A;
  floor.above = excess_A > rounding_A ? excess_A / floor.rmse_A : 0;
  const double open_A = floor.rmse_A - floor.lower_bound_A;
  floor.gap = open_A > rounding_A ? open_A / floor.rmse_A : 0;
  return floor;
}

// Bounds of the parameters of a fit without effects.
std::vector<ParameterBounds> BoundsOf(const FitReport& report) {
  std::vector<ParameterBounds> bounds;
  bounds.reserve(report.estimates.size());
  for (const Estimate& e : report.estimates) bounds.push_back(e.bounds);
  return bounds;
}

double RefinedRmse(const FitReport& report, const FitOptions& options) {
  return Rmse(report.device, options.objective, report.refined.data(), report.curve.voltage_V,
              report.curve.current_A);
}

}  // namespace

CertifyOptions RangesOf(const std::vector<ParameterBounds>& bounds, ConstantSet constants,
                        std::vector<Model> models) {
  CertifyOptions options;
  options.constants = constants;
  options.models = std::move(models);
  options.rs_lower_ohm = bounds[kRs].lower;
  options.rs_upper_ohm = bounds[kRs].upper;
  options.n_lower = bounds[IdealityIndex(0)].lower;
  options.n_upper = bounds[IdealityIndex(0)].upper;
  for (int d = 1; IdealityIndex(d) < static_cast<int>(bounds.size()); ++d) {
    options.n_lower = std::min(options.n_lower, bounds[IdealityIndex(d)].lower);
    options.n_upper = std::max(options.n_upper, bounds[IdealityIndex(d)].upper);
  }
  options.iph_lower_A = bounds[kIph].lower;
  options.iph_upper_A = bounds[kIph].upper;
  options.rsh_lower_ohm = bounds[kRsh].lower;
  options.rsh_upper_ohm = bounds[kRsh].upper;
  for (int d = 0; IdealityIndex(d) < static_cast<int>(bounds.size()); ++d) {
    const ParameterBounds& is = bounds[SaturationCurrentIndex(d)];
    const ParameterBounds& n = bounds[IdealityIndex(d)];
    // A diode fixed at Is = 0 is represented by one that hardly conducts.
    options.diodes.push_back({n.lower, n.upper, is.lower, std::max(is.upper, kLeastSaturation_A)});
  }
  // A single value of n becomes a narrow range.
  if (!(options.n_lower < options.n_upper)) options.n_upper = options.n_lower * (1 + 1e-9);
  return options;
}

Expected<CertifyOptions> CertifyWithin(const BoundsSpec& spec, const IvCurve& curve,
                                       const CertifyOptions& options) {
  if (HasOwnRanges(options)) {
    return Fail("bounds '" + spec.name +
                "' hold every range: leave out those of n, Rs, Iph, Is and Rsh, or put them into a "
                "bounds file");
  }
  Model largest = options.models.empty() ? Model::kTripleDiode : Model::kSingleDiode;
  for (const Model model : options.models) largest = std::max(largest, model);
  const Device device = MakeDevice(largest, curve.conditions, options.constants);
  TRY(const std::vector<ParameterBounds> bounds, MakeBounds(spec, device, WithoutBeyondVoc(curve)));
  CertifyOptions within = RangesOf(bounds, options.constants, options.models);
  within.objective = options.objective;
  within.tolerance = options.tolerance;
  within.rigorous = options.rigorous;
  within.effort = options.effort;
  within.bounds = spec.name;
  return within;
}

FitReport WithFloor(FitReport report, const FitOptions& options, const Observer& observer) {
  if (!options.floor || report.interrupted) return report;
  if (!report.usable) {
    report.warnings.emplace_back("No floor was looked for: the fit is not usable.");
    return report;
  }
  CertifyOptions ranges = RangesOf(BoundsOf(report), options.constants, {});
  ranges.objective = options.objective;
  Expected<FloorReport> floor =
      ProveFloor(report.curve, ranges, RefinedRmse(report, options), observer, &report.interrupted);
  if (!floor) {
    report.warnings.push_back("No floor was found: " + floor.error().message + ".");
    return report;
  }
  const bool weighed = report.errors && report.errors->weighed;
  floor->minimised =
      report.curve.sigma_A.empty() && options.loss == Loss::kSquared && !weighed && options.polish;
  report.floor = *floor;
  return report;
}

Expected<FitReport> FitWithFloor(const IvCurve& curve, const FitOptions& options, bool auto_model,
                                 const Observer& observer) {
  TRY(FitReport report,
      auto_model ? FitAuto(curve, options, observer) : Fit(curve, options, observer));
  return WithFloor(std::move(report), options, observer);
}

}  // namespace lyrefit
