#include "lyrefit/family/family_echo.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/fit/statistics.h"

namespace lyrefit {

std::vector<OptionEcho> FamilyEcho(const FamilyOptions& options) {
  const FamilyOptions defaults;
  std::vector<OptionEcho> echoes;
  const auto echo = [&](const char* name, const std::string& value, const std::string& usual) {
    if (value != usual) echoes.push_back({name, value, usual});
  };
  echo("family", ToText(options.law), ToText(defaults.law));
  echo("model", ToText(options.model), ToText(defaults.model));
  if (options.shunt) echo("shunt", ToText(*options.shunt), "");
  echo("recombination", options.recombination ? "yes" : "no", "no");
  echo("objective", ToText(options.objective), ToText(defaults.objective));
  echo("constants", ToText(options.constants), ToText(defaults.constants));
  for (const auto& [key, value] : options.fixed) {
    echo("fix", fmt::format("{}={:g}", key, value), "");
  }
  for (const std::string& name : options.freed) echo("free", name, "");
  for (const EffectUse& use : options.with) echo("with", DescribeUse(use), "");
  echo("force", options.force_effects ? "yes" : "no", "no");
  for (const auto& [key, range] : options.bounds) {
    echo("bound", fmt::format("{}={:g}:{:g}", key, range.first, range.second), "");
  }
  echo("weights", ToText(options.weights), ToText(defaults.weights));
  echo("algorithm", ToText(options.search.algorithm), ToText(defaults.search.algorithm));
  AppendNonDefaults(options.search, defaults.search, kSearchOptionTable, &echoes);
  if (options.searcher) echo("search", "of its own", "");
  if (options.starts != StartsFrom::kAll) {
    echo("starts", options.starts == StartsFrom::kShape ? "shape" : "search", "all");
  }
  echo("search-curves", NumberText(options.search_curves), NumberText(defaults.search_curves));
  echo("fit-curves", NumberText(options.fit_curves), NumberText(defaults.fit_curves));
  echo("irradiance-offset", options.irradiance_offset ? "yes" : "no", "no");
  echo("temperature-offset", options.temperature_offset ? "yes" : "no", "no");
  echo("irradiance-accuracy", NumberText(100 * options.irradiance_accuracy), "0");
  echo("temperature-accuracy", NumberText(options.temperature_accuracy_K), "0");
  echo("random-baseline", options.random_baseline ? "yes" : "no", "yes");
  echo("intervals", options.intervals ? "yes" : "no", "yes");
  echo("free-fits", options.free_fits ? "yes" : "no", "yes");
  echo("folds", NumberText(options.folds), NumberText(defaults.folds));
  for (const std::string& id : options.leave_out) echo("leave-out", id, "");
  for (const NamedParameters& other : options.against) echo("against", other.name, "");
  return echoes;
}

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

// Residuals that hang together within curves make intervals from points too narrow.
void WarnOfMisfit(const FamilyReport& report, std::vector<std::string>* warnings) {
  double joint = 0, free = 0, points = 0, largest = 0;
  for (const FamilyCurve& curve : report.curves) {
    const double alone = curve.free_rmse.solved_current_A;
    if (curve.role != CurveRole::kFitted || !std::isfinite(alone)) continue;
    const double count = static_cast<double>(curve.points);
    joint += count * curve.rmse.solved_current_A * curve.rmse.solved_current_A;
    free += count * alone * alone;
    points += count;
    largest = std::max(largest, curve.short_circuit_current_A);
  }
  constexpr double kVisible = 1.5;
  constexpr double kRounding = 1e-9;  // of the current: made curves fit that well
  if (std::sqrt(joint / std::max(points, 1.0)) < kRounding * largest) return;
  if (!(points > 0) || !(joint > kVisible * kVisible * free)) return;
  warnings->push_back(fmt::format(
      "The joint fit misses the curves by {:.3g} A, fits of their own by {:.3g} A "
      "(solved-current): the law, the stated conditions or a curve does not fit the others. The "
      "intervals take every point as independent and are too narrow then; those by whole curves "
      "(jackknife) are the honest ones.",
      std::sqrt(joint / points), std::sqrt(free / points)));
}

void WarnOfOddCurves(const FamilyReport& report, std::vector<std::string>* warnings) {
  if (!report.without_odd) return;
  for (const std::string& id : report.without_odd->ids) {
    warnings->push_back(fmt::format(
        "Curve {} does not belong to the device of the others, or its irradiance or temperature is "
        "wrong: without it the joint RMSE falls from {:.4g} to {:.4g} A (solved-current). To fit "
        "without it: --leave-out {}",
        id, report.rmse.refined.solved_current_A, report.without_odd->rmse.solved_current_A, id));
  }
}

}  // namespace

std::vector<std::string> FamilyWarnings(const FamilyReport& report, const FamilyOptions& options) {
  std::vector<std::string> warnings;
  if (report.interrupted) warnings.push_back("Interrupted: what follows is unfinished.");
  for (const RejectedCurve& rejected : report.rejected) {
    warnings.push_back("Not read: " + rejected.error.ToString());
  }
  for (const FamilyCurve& curve : report.curves) {
    if (curve.role != CurveRole::kLeftOut || curve.reason == "left out as asked") continue;
    warnings.push_back(fmt::format("Curve {} is left out: {}.", curve.id, curve.reason));
  }
  WarnOfOddCurves(report, &warnings);
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
