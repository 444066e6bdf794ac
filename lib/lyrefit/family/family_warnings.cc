#include "lyrefit/family/refine_family.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/reasons.h"

namespace lyrefit {

namespace {

// How far the law is from what was measured: of key points in units of their errors, of curves in
// units of what fits of their own leave; NaN: unknown.
struct Misfit {
  double times = kUnknown;
  double joint_A = kUnknown;  // of curves: by the law
  double free_A = kUnknown;   // of curves: by fits of their own
  bool by_law = false;        // the law itself misses, not noise, a condition or one curve
};

constexpr double kLawMisses = 3;  // of `times`: from here on by_law

Misfit MisfitOf(const FamilyReport& report) {
  Misfit misfit;
  if (report.key_points) {
    misfit.times = report.key_points->scale;
    misfit.by_law = misfit.times > kLawMisses && !report.without_outliers;
    return misfit;
  }
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
  constexpr double kRounding = 1e-9;  // relative to the current; fits of simulated curves reach it
  if (!(points > 0) || std::sqrt(joint / points) < kRounding * largest) return misfit;
  misfit.joint_A = std::sqrt(joint / points);
  misfit.free_A = std::sqrt(free / points);
  misfit.times = misfit.joint_A / misfit.free_A;
  misfit.by_law = misfit.times > kLawMisses && !report.without_outliers;
  return misfit;
}

// "pvsyst or desoto": the laws with more freedom over temperature than "cec", but for the own.
std::string OtherLaws(TranslationLaw own) {
  std::string laws;
  for (const TranslationLaw law : {TranslationLaw::kPvsyst, TranslationLaw::kDeSoto}) {
    if (law != own) laws += (laws.empty() ? "" : " or ") + std::string(ToText(law));
  }
  return laws;
}

// What follows from a law that misses: another one, and what its files carry.
std::string TryOthers(const FamilyReport& report) {
  const int n = report.translation.n;
  const bool low = n >= 0 && report.refined[n] < 1;
  return fmt::format(
      "To try: the law {}. Parameters written for other programs carry this error{}.",
      OtherLaws(report.translation.spec.law),
      low ? fmt::format(", and the ideality {:.4g} makes up for it", report.refined[n]) : "");
}

void WarnOfParameters(const FamilyReport& report, bool law_misses,
                      std::vector<std::string>* warnings) {
  for (const Estimate& e : report.estimates) {
    if (e.fixed || e.at_bound == BoundSide::kNone || !e.identifiable) continue;
    warnings->push_back(fmt::format("{} ended at its {} bound ({:.6g} {}).", e.info.name,
                                    ToText(e.at_bound), e.refined, e.info.unit));
  }
  const int n = report.translation.n;
  if (n >= 0 && report.refined[n] < 1 && !law_misses) {
    warnings->push_back(fmt::format(
        "The ideality {:.4g} lies below 1: the number of cells or the temperatures are likely "
        "wrong.",
        report.refined[n]));
  }
}

void WarnOfKeyPoints(const FamilyReport& report, std::vector<std::string>* warnings) {
  const KeyPointSummary& points = *report.key_points;
  warnings->push_back(fmt::format(
      "The law {} does not describe these measurements: it misses the key points by {:.2g} times "
      "their errors ({}), Pmp by {:.2g} %. {}",
      ToText(report.translation.spec.law), points.scale, KeyPointErrorsText(points.errors),
      100 * points.max_power, TryOthers(report)));
}

// Correlated residuals within curves make intervals that take points as independent too narrow.
void WarnOfCurves(const FamilyReport& report, const Misfit& misfit,
                  std::vector<std::string>* warnings) {
  warnings->push_back(fmt::format(
      "The joint fit misses the curves by {:.3g} A, fits of their own by {:.3g} A "
      "(solved-current): the law, the stated conditions or a curve does not fit the others. The "
      "intervals take every point as independent and are too narrow then; those by whole curves "
      "(jackknife) are the honest ones.{}",
      misfit.joint_A, misfit.free_A, misfit.by_law ? " " + TryOthers(report) : std::string()));
}

void WarnOfMisfit(const FamilyReport& report, const Misfit& misfit,
                  std::vector<std::string>* warnings) {
  constexpr double kVisible = 1.5;
  if (report.key_points) {
    if (misfit.by_law) WarnOfKeyPoints(report, warnings);
  } else if (misfit.times > kVisible) {
    WarnOfCurves(report, misfit, warnings);
  }
}

// "Imp of 800 W/m2, 25 C looks wrong: ..."
std::string CellWords(const OutlierCell& cell) {
  return fmt::format(
      "{} of {} looks wrong: {:.4g} {} is {:+.1f} % off the {:.4g} {} of a fit without it",
      cell.point, cell.id, cell.measured, cell.unit, 100 * (cell.measured / cell.expected - 1),
      cell.expected, cell.unit);
}

void WarnOfOutlierCurves(const FamilyReport& report, std::vector<std::string>* warnings) {
  if (!report.without_outliers) return;
  for (const OutlierCell& cell : report.without_outliers->cells) {
    warnings->push_back(fmt::format(
        "{}. The parameters of this report include it. Correct the cell, empty it, or leave the "
        "condition out: --leave-out '{}'",
        CellWords(cell), cell.id));
  }
  if (report.key_points) return;
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
  std::vector<std::string> left;
  for (const RejectedCurve& rejected : report.rejected) {
    left.push_back("Not read: " + rejected.error.ToString());
  }
  for (const FamilyCurve& curve : report.curves) {
    if (curve.role != CurveRole::kLeftOut || curve.reason == "left out as asked") continue;
    left.push_back(fmt::format("Curve {} is left out: {}.", curve.id, curve.reason));
  }
  for (std::string& once : OncePerKind(left)) warnings.push_back(std::move(once));
  WarnOfOutlierCurves(report, &warnings);
  if (report.estimates.empty()) return warnings;
  const Misfit misfit = MisfitOf(report);
  WarnOfParameters(report, misfit.by_law, &warnings);
  WarnOfMisfit(report, misfit, &warnings);
  if (options.temperature_offset && options.freed.empty() &&
      options.law == TranslationLaw::kPvsyst) {
    warnings.push_back(
        "A common temperature error and mu_gamma look nearly alike: see their correlation.");
  }
  return warnings;
}

}  // namespace lyrefit
