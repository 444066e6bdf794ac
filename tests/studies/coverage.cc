#include "studies/coverage.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lyrefit/base/median.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/seconds.h"
#include "lyrefit/base/version.h"
#include "studies/coverage_sets.h"

namespace lyrefit {
namespace {

FamilyOptions FitOptionsOf(const CoverageOptions& options) {
  FamilyOptions family = options.family;
  family.random_baseline = family.individual_fits = false;
  family.intervals = true;
  family.folds = family.fit_curves = 0;
  family.threads = 1;
  return family;
}

// The shared parameters, then the fitted offsets.
std::vector<ParameterInfo> CoveredParameters(const Translation& translation,
                                             const CoverageOptions& options) {
  std::vector<ParameterInfo> infos = translation.parameters;
  if (options.family.temperature_offset) {
    infos.push_back({"dT", "temperature_offset_K", "K", "true minus read temperature"});
  }
  if (options.family.irradiance_offset) {
    infos.push_back({"dG", "irradiance_offset_W_m2", "W/m2", "true minus read irradiance"});
  }
  return infos;
}

CoverageRow OffsetRow(double error, const Interval& interval) {
  CoverageRow row;
  row.truth = error == 0 ? 0 : -error;
  row.interval = interval;
  row.identifiable = std::isfinite(interval.low_95) && std::isfinite(interval.high_95);
  return row;
}

std::vector<CoverageRow> RowsOf(const SimulatedSet& made, const FamilyReport& report,
                                const CoverageOptions& options) {
  std::vector<CoverageRow> rows;
  for (std::size_t i = 0; i < made.truth.size(); ++i) {
    const Estimate& e = report.estimates[i];
    const bool under_errors = i < report.under_errors.size() && e.identifiable;
    const Interval plain = {e.refined, e.standard_error, e.low_95, e.high_95};
    rows.push_back(
        {made.truth[i], under_errors ? report.under_errors[i] : plain, e.fixed, e.identifiable});
  }
  if (options.family.temperature_offset) {
    rows.push_back(OffsetRow(options.temperature_error_K, report.temperature_offset_K));
  }
  if (options.family.irradiance_offset) {
    rows.push_back(OffsetRow(options.irradiance_error_W_m2, report.irradiance_offset_W_m2));
  }
  return rows;
}

CoverageSet FitSet(const SimulatedSet& made, const CoverageOptions& options,
                   const FamilyFitter& fit, const Observer& observer, bool* interrupted) {
  CoverageSet set;
  const Instant begin = Now();
  set.cells_in_series = made.translation.spec.cells_in_series;
  set.curves = static_cast<int>(made.set.curves.size());
  const Expected<FamilyReport> report = fit(made.set, FitOptionsOf(options), observer);
  set.seconds = SecondsSince(begin);
  *interrupted = report && report->interrupted;
  if (!report) {
    set.error = report.error().ToString();
  } else if (!report->usable || report->estimates.size() != made.truth.size()) {
    set.error = "the fit is not usable";
  } else {
    set.rows = RowsOf(made, *report, options);
    set.weights = report->weights;
    set.correlated = !report->under_errors.empty();
  }
  return set;
}

ParameterCoverage Count(const ParameterInfo& info, bool offset, std::size_t index,
                        const std::vector<CoverageSet>& sets) {
  ParameterCoverage count;
  count.info = info;
  count.offset = offset;
  std::vector<double> widths;
  for (const CoverageSet& set : sets) {
    if (set.rows.empty() || set.rows[index].fixed) continue;
    const CoverageRow& row = set.rows[index];
    ++count.fitted;
    count.not_identifiable += row.identifiable ? 0 : 1;
    const double low = row.interval.low_95, high = row.interval.high_95;
    if (!row.identifiable || std::isnan(low) || std::isnan(high)) continue;
    ++count.counted;
    count.covered += low <= row.truth && row.truth <= high ? 1 : 0;
    widths.push_back(0.5 * (high - low) / (offset ? 1 : std::fabs(row.truth)));
  }
  if (count.counted > 0) {
    const Share share = WilsonInterval(count.covered, count.counted);
    count.coverage = static_cast<double>(count.covered) / count.counted;
    count.low_95 = share.low_95;
    count.high_95 = share.high_95;
  }
  count.median_half_width = Median(std::move(widths));
  return count;
}

// A coverage study in progress. Sets arrive from any thread, each in its own slot.
class CoverageRun {
 public:
  CoverageRun(const CoverageOptions& options, const FamilyFitter& fit, const Observer& observer)
      : options_(options), fit_(fit), slots_(options.sets), progress_(observer) {
    progress_.BeginSilently("coverage", options.sets);
  }

  std::vector<CoverageSet> Run() {
    progress_.Report();
    ParallelFor(options_.sets, options_.threads, [this](int index) { RunSet(index); });
    std::vector<CoverageSet> done;
    for (auto& slot : slots_) {
      if (slot) done.push_back(std::move(*slot));
    }
    return done;
  }

 private:
  void RunSet(int index) {
    if (progress_.Stopped()) return;
    CoverageSet set;
    if (const auto made = SimulateSet(options_, index)) {
      bool interrupted = false;
      set = FitSet(*made, options_, fit_, progress_.stop().AsObserver(), &interrupted);
      if (interrupted) return;
    } else {
      set.error = made.error().ToString();
    }
    slots_[index] = std::move(set);
    progress_.Step();
  }

  const CoverageOptions& options_;
  const FamilyFitter& fit_;
  std::vector<std::optional<CoverageSet>> slots_;
  const ProgressReporter progress_;
};

}  // namespace

Share WilsonInterval(int hits, int trials) {
  if (trials <= 0) return {};
  constexpr double kZ = 1.959963984540054;  // 97.5 % of the standard normal
  const double n = trials, p = hits / n;
  const double middle = (p + kZ * kZ / (2 * n)) / (1 + kZ * kZ / n);
  const double reach = kZ / (1 + kZ * kZ / n) * std::sqrt(p * (1 - p) / n + kZ * kZ / (4 * n * n));
  return {std::max(0.0, middle - reach), std::min(1.0, middle + reach)};
}

Expected<CoverageReport> Coverage(const CoverageOptions& options, const FamilyFitter& fit,
                                  const Observer& observer) {
  if (auto valid = ValidateOptions(options, kCoverageOptionTable); !valid) {
    return tl::unexpected(valid.error());
  }
  if (auto valid = ValidateThreads(options.threads); !valid) return tl::unexpected(valid.error());
  if (options.cells_in_series < 1) return Fail("expected at least 1 cell in series");
  // Simulating the first set reports every error of a module from the command line.
  if (auto tried = SimulateSet(options, 0); !tried) return tl::unexpected(tried.error());
  const auto translation = CoverageTranslation(options, options.cells_in_series);
  if (!translation) return tl::unexpected(translation.error());
  const Instant begin = Now();
  CoverageReport report;
  report.version = Version();
  report.options = options;
  CoverageRun run(options, fit, observer);
  report.sets = run.Run();
  report.interrupted = static_cast<int>(report.sets.size()) < options.sets;
  for (const CoverageSet& set : report.sets) {
    report.failed += set.rows.empty() ? 1 : 0;
    report.relative += set.weights == FamilyWeights::kIsc ? 1 : 0;
    report.correlated += set.correlated ? 1 : 0;
  }
  const std::vector<ParameterInfo> infos = CoveredParameters(*translation, options);
  for (std::size_t i = 0; i < infos.size(); ++i) {
    report.parameters.push_back(
        Count(infos[i], i >= translation->parameters.size(), i, report.sets));
  }
  report.seconds = SecondsSince(begin);
  return report;
}

}  // namespace lyrefit
