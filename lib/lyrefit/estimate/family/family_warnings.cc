#include "lyrefit/estimate/family/family_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/estimate/fit/statistics.h"

namespace lyrefit {

namespace {

void WarnOfParameters(const FamilyReport& report, std::vector<std::string>* warnings) {
  for (const Estimate& e : report.estimates) {
    if (e.fixed || e.at_bound == BoundSide::kNone || !e.identifiable) continue;
    warnings->push_back(fmt::format("{} ended at its {} bound ({:.6g} {}).", e.info.name,
                                    ToText(e.at_bound), e.refined, e.info.unit));
  }
  const int n = report.translation.n;
  if (n >= 0 && report.refined[n] < 1) {
    warnings->push_back(fmt::format(
        "The ideality {:.4g} lies below 1: the number of cells or the temperatures are likely "
        "wrong.",
        report.refined[n]));
  }
}

// Correlated residuals within curves make intervals that take points as independent too narrow.
void WarnOfMisfit(const FamilyReport& report, std::vector<std::string>* warnings) {
  double joint = 0, free = 0, points = 0, largest = 0;
  for (const FamilyCurve& curve : report.curves) {
    const double alone = curve.individual_rmse.solved_current_A;
    if (curve.role != CurveRole::kFitted || !std::isfinite(alone)) continue;
    const double count = static_cast<double>(curve.points);
    joint += count * curve.rmse.solved_current_A * curve.rmse.solved_current_A;
    free += count * alone * alone;
    points += count;
    largest = std::max(largest, curve.short_circuit_current_A);
  }
  constexpr double kVisible = 1.5;
  constexpr double kRounding = 1e-9;  // relative to the current; fits of simulated curves reach it
  if (std::sqrt(joint / std::max(points, 1.0)) < kRounding * largest) return;
  if (!(points > 0) || !(joint > kVisible * kVisible * free)) return;
  warnings->push_back(fmt::format(
      "The joint fit misses the curves by {:.3g} A, fits of their own by {:.3g} A "
      "(solved-current): the law, the stated conditions or a curve does not fit the others. The "
      "intervals take every point as independent and are too narrow then; those by whole curves "
      "(jackknife) are the honest ones.",
      std::sqrt(joint / points), std::sqrt(free / points)));
}

void WarnOfOutlierCurves(const FamilyReport& report, std::vector<std::string>* warnings) {
  if (!report.without_outliers) return;
  for (const std::string& id : report.without_outliers->ids) {
    warnings->push_back(fmt::format(
        "Curve {} does not belong to the device of the others, or its irradiance or temperature is "
        "wrong: without it the joint RMSE falls from {:.4g} to {:.4g} A (solved-current). To fit "
        "without it: --leave-out {}",
        id, report.rmse.refined.solved_current_A, report.without_outliers->rmse.solved_current_A,
        id));
  }
}

}  // namespace

std::vector<std::string> FamilyWarnings(const FamilyReport& report, const FamilyOptions& options) {
  std::vector<std::string> warnings;
  if (report.interrupted) warnings.push_back("Interrupted: what follows is unfinished.");
  for (const NamedParameters& other : options.against) {
    warnings.insert(warnings.end(), other.warnings.begin(), other.warnings.end());
  }
  for (const RejectedCurve& rejected : report.rejected) {
    warnings.push_back("Not read: " + rejected.error.ToString());
  }
  for (const FamilyCurve& curve : report.curves) {
    if (curve.role != CurveRole::kLeftOut || curve.reason == "left out as asked") continue;
    warnings.push_back(fmt::format("Curve {} is left out: {}.", curve.id, curve.reason));
  }
  WarnOfOutlierCurves(report, &warnings);
  if (report.estimates.empty()) return warnings;
  WarnOfParameters(report, &warnings);
  WarnOfMisfit(report, &warnings);
  if (options.temperature_offset && options.freed.empty() &&
      options.law == TranslationLaw::kPvsyst) {
    warnings.push_back(
        "A common temperature error and mu_gamma look nearly alike: see their correlation.");
  }
  return warnings;
}

}  // namespace lyrefit
