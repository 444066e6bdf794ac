#include "lyrefit/family/fit_individually.h"

#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/base/observer.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/seconds.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/curve/check_readings.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/family/refine_family.h"
#include "lyrefit/model/reporting_units.h"

namespace lyrefit {
namespace {

constexpr double kCorrelated = 0.01;  // p-value of the runs test

}  // namespace

FitOptions OwnFitOptions(const FamilyOptions& options) {
  FitOptions fit;
  fit.model = options.model;
  fit.objective = options.objective;
  fit.constants = options.constants;
  fit.random_baseline = false;
  fit.intervals = Intervals::kNone;
  fit.threads = 1;
  return fit;
}

IndividualFits FitEveryCurve(const std::vector<const IvCurve*>& curves, const FitOptions& options,
                             int threads, const Observer& observer) {
  const Instant begin = Now();
  IndividualFits fits;
  fits.reports.resize(curves.size());
  const ProgressReporter progress(observer, "curves", static_cast<std::int64_t>(curves.size()));
  ParallelFor(static_cast<int>(curves.size()), threads, [&](int c) {
    if (progress.Stopped()) return;
    Expected<FitReport> report = Fit(*curves[c], options, progress.stop().AsObserver());
    if (report && report->interrupted) return;
    fits.reports[c] = std::move(report);
    progress.Step();
  });
  fits.interrupted = progress.Stopped();
  fits.seconds = SecondsSince(begin);
  return fits;
}

void FillIndividualFit(const FitReport& fit, FamilyCurve* curve) {
  curve->individual_parameters = Reported(fit.device, fit.refined);
  curve->individual_estimates = fit.estimates;
  curve->individual_under_errors = fit.under_errors;
  curve->free_errors = fit.errors;
  curve->individual_rmse = fit.polished ? fit.rmse.refined : fit.rmse.searched;
}

FamilyCurve DescribeCurve(const IvCurve& curve) {
  FamilyCurve described;
  described.id = curve.name;
  described.points = curve.size();
  described.irradiance_W_m2 = curve.conditions.irradiance_W_m2;
  described.temperature_C = curve.conditions.cell_temperature_K - kZeroCelsius_K;
  described.irradiance_known = curve.irradiance_known;
  described.temperature_known = curve.temperature_known;
  described.short_circuit_current_A =
      FindKeyPoints(curve.voltage_V, curve.current_A).short_circuit_current_A;
  return described;
}

CurveSet KeptCurves(const CurveSet& set, const FamilyReport& report) {
  CurveSet kept;
  for (std::size_t c = 0; c < set.curves.size(); ++c) {
    if (report.curves[c].role != CurveRole::kLeftOut) kept.curves.push_back(set.curves[c]);
  }
  return kept;
}

std::vector<std::string> DoubtsOfKept(const CurveSet& set, const FamilyReport& report) {
  const auto doubts = JudgeReadings(KeptCurves(set, report).curves);
  return doubts ? *doubts : std::vector<std::string>();  // refused curves are left out
}

namespace {

FamilyReport FreeHead(const CurveSet& set, const FamilyOptions& options) {
  FamilyReport report;
  report.version = Version();
  report.name = set.name;
  report.source = set.source;
  report.free = true;
  report.with = options.with;
  report.objective = options.objective;
  report.translation.spec.model = options.model;
  report.rejected = set.rejected;
  report.assumptions = SentencesOf(set.assumptions);
  report.search_options = options.search;
  return report;
}

// Options of the individual fit of every curve.
FitOptions FreeOptions(const FamilyOptions& options) {
  FitOptions fit = OwnFitOptions(options);
  fit.fixed = options.fixed;
  fit.with = options.with;
  fit.force_effects = options.force_effects;
  fit.bounds.overrides = options.bounds;
  fit.errors = options.errors;
  fit.search = options.search;
  if (options.intervals) fit.intervals = Intervals::kProfile;
  return fit;
}

// The rows of all curves of the set, and the curves to be fitted.
struct WantedCurves {
  std::vector<FamilyCurve> rows;
  std::vector<const IvCurve*> curves;
};

Expected<WantedCurves> FindWantedCurves(const CurveSet& set, const FamilyOptions& options) {
  const std::vector<std::string>& unwanted = options.leave_out;
  WantedCurves wanted;
  for (const IvCurve& curve : set.curves) {
    FamilyCurve& row = wanted.rows.emplace_back(DescribeCurve(curve));
    if (std::find(unwanted.begin(), unwanted.end(), curve.name) == unwanted.end()) {
      wanted.curves.push_back(&curve);
    } else {
      row.reason = "left out as asked";
      row.role = CurveRole::kLeftOut;
    }
  }
  for (const std::string& id : unwanted) {
    const bool found = std::any_of(set.curves.begin(), set.curves.end(),
                                   [&](const IvCurve& curve) { return curve.name == id; });
    if (!found) return Fail(fmt::format("leave-out: the set has no curve {}", id));
  }
  if (wanted.curves.empty()) {
    return Fail("expected at least one curve, found none", set.source);
  }
  return wanted;
}

// The rows of all curves with their fits, and counts of the outcomes.
struct FittedRows {
  std::vector<FamilyCurve> rows;
  std::vector<std::string> warnings;  // of curves that cannot be fitted and are left out
  int fitted = 0;
  int failed = 0;      // fits that are not usable
  int correlated = 0;  // fits with fewer sign changes of the residuals than expected
  int refused = 0;
  const Error* first = nullptr;         // first error of a refused curve
  const FitReport* unusable = nullptr;  // first fit that is not usable
};

FittedRows WithFits(std::vector<FamilyCurve> rows, const IndividualFits& fits) {
  FittedRows fitted;
  fitted.rows = std::move(rows);
  std::size_t next = 0;
  for (FamilyCurve& curve : fitted.rows) {
    if (curve.role == CurveRole::kLeftOut) continue;
    const std::optional<Expected<FitReport>>& one = fits.reports[next++];
    if (one && *one) {
      const FitReport& fit = **one;
      FillIndividualFit(fit, &curve);
      fitted.fitted += fit.usable;
      fitted.failed += !fit.usable;
      if (!fit.usable && fitted.unusable == nullptr) fitted.unusable = &fit;
      const ResidualStatistics& residuals = fit.residuals;
      fitted.correlated +=
          residuals.runs < residuals.expected_runs && residuals.runs_p_value < kCorrelated;
      continue;
    }
    curve.role = CurveRole::kLeftOut;
    curve.reason = one ? one->error().message : "interrupted before its turn";
    if (!one) continue;
    if (fitted.first == nullptr) fitted.first = &one->error();
    ++fitted.refused;
    fitted.warnings.push_back(fmt::format("Curve {} is left out: {}.", curve.id, curve.reason));
  }
  return fitted;
}

std::vector<std::string> WarningsOf(const FittedRows& fitted) {
  std::vector<std::string> warnings = fitted.warnings;
  if (fitted.failed > 0) {
    warnings.push_back(fmt::format("{} of {} fits are not usable; the first, of curve {}: {}.",
                                   fitted.failed, fitted.failed + fitted.fitted,
                                   fitted.unusable->curve.name,
                                   fitted.unusable->not_usable_because));
  }
  if (2 * fitted.correlated > fitted.fitted) {
    warnings.push_back(fmt::format(
        "The residuals keep their sign too long in {} of {} fits (p below {:g} in the runs test): "
        "a law that misses, or noise that hangs together from point to point. The intervals of the "
        "single fits are too narrow then; the spread between fits of equal curves is the honest "
        "measure.",
        fitted.correlated, fitted.fitted, kCorrelated));
  }
  return warnings;
}

}  // namespace

Expected<FamilyReport> FitIndividually(const CurveSet& set, const FamilyOptions& options,
                                       const Observer& observer) {
  TRY(ValidateThreads(options.threads));
  TRY(WantedCurves wanted, FindWantedCurves(set, options));
  const IndividualFits fits =
      FitEveryCurve(wanted.curves, FreeOptions(options), options.threads, observer);
  FittedRows fitted = WithFits(std::move(wanted.rows), fits);
  // If no curve can be fitted, the options or the set are at fault.
  if (fitted.first != nullptr && fitted.refused == static_cast<int>(wanted.curves.size())) {
    return tl::unexpected(*fitted.first);
  }
  FamilyReport report = FreeHead(set, options);
  report.curves = std::move(fitted.rows);
  report.cells_in_series = wanted.curves[0]->conditions.cells_in_series;
  report.individual_seconds = report.seconds = fits.seconds;
  report.interrupted = fits.interrupted;
  if (!options.with.empty()) report.taken = std::make_shared<CurveSet>(KeptCurves(set, report));
  report.doubts = DoubtsOfKept(set, report);
  report.warnings = report.doubts;
  const std::vector<std::string> found = WarningsOf(fitted);
  report.warnings.insert(report.warnings.end(), found.begin(), found.end());
  report.usable = fitted.fitted > 0;
  return report;
}

}  // namespace lyrefit
