#include "lyrefit/trend/trend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "lyrefit/base/reasons.h"
#include "lyrefit/base/seconds.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/curve/date_time.h"
#include "lyrefit/report/text_parts.h"
#include "lyrefit/trend/blocks.h"
#include "lyrefit/trend/day_series.h"
#include "lyrefit/trend/operating_rows.h"
#include "lyrefit/trend/quantities.h"
#include "lyrefit/trend/trend_device.h"
#include "lyrefit/trend/trend_words.h"

namespace lyrefit {
namespace {

std::vector<TrendReason> CountReasons(const std::vector<TrendRow>& rows) {
  std::map<std::string, TrendReason> reasons;
  for (const TrendRow& row : rows) {
    if (row.reason.empty()) continue;
    TrendReason& reason = reasons[WithoutNumbers(row.reason)];
    if (reason.rows++ == 0) reason.reason = row.reason;
    reason.doubtful = row.state == TrendRowState::kDoubtful;
    if (!std::isfinite(row.time_s)) continue;
    reason.first_s = std::fmin(reason.first_s, row.time_s);
    reason.last_s = std::fmax(reason.last_s, row.time_s);
  }
  std::vector<TrendReason> counted;
  counted.reserve(reasons.size());
  for (const auto& [text, reason] : reasons) counted.push_back(reason);
  return counted;
}

// The part of the report that is known of series and blocks.
TrendReport SeriesReport(const TrendSeries& series, const TrendBlocks& blocks,
                         const TrendOptions& options) {
  TrendReport report;
  report.version = Version();
  report.seed = options.seed;
  report.options = NonDefaults(options, kTrendOptionTable);
  report.interrupted = series.interrupted;
  report.name = series.name;
  report.source = series.source;
  report.law = series.law;
  report.cells_in_series = series.device->cells_in_series;
  report.substrings = series.device->substrings;
  report.ideality = series.device->n;
  report.rows = static_cast<std::int64_t>(series.rows.size());
  report.states = blocks.states;
  report.days = blocks.size();
  report.first_s = blocks.rows.front().time_s;
  report.last_s = blocks.rows.back().time_s;
  report.reference_end_s = blocks.reference_end_s;
  report.reference_capped = blocks.reference_capped;
  return report;
}

// Leaves out what repeats another row to the last digit, as a file that holds a day twice has it.
void LeaveOutRepeated(std::vector<TrendRow>* rows) {
  const auto values = [](const TrendRow& row) {
    return std::tuple(row.time_s, row.irradiance_W_m2, row.temperature_C, row.voltage_V,
                      row.current_A);
  };
  std::set<decltype(values(TrendRow()))> known;
  for (TrendRow& row : *rows) {
    if (!CountsInBlocks(row) || known.insert(values(row)).second) continue;
    row.state = TrendRowState::kUnusable;
    row.reason = "the same measurement again";
  }
}

// The rows of a series with what tells whether they count.
std::vector<TrendRow> RowsToJudge(const TrendSeries& series, const TrendOptions& options) {
  std::vector<TrendRow> rows = series.rows;
  LeaveOutRepeated(&rows);
  if (series.source == TrendSource::kOperatingPoints) {
    ReduceOperatingPoints(*series.device, options, &rows);
  }
  return rows;
}

TrendSeries Until(const TrendSeries& series, double end_s) {
  TrendSeries first = series;
  first.rows.clear();
  for (const TrendRow& row : series.rows) {
    if (!(row.time_s >= end_s)) first.rows.push_back(row);
  }
  return first;
}

}  // namespace

Expected<TrendReport> FindTrend(const TrendSeries& series, const TrendOptions& options,
                                const Observer& observer) {
  TRY(ValidateOptions(options, kTrendOptionTable));
  const Instant start = Now();
  const Observer nobody;  // a series whose reading was stopped is judged as far as it goes
  const ProgressReporter progress(series.interrupted ? nobody : observer, "trend", 2);
  std::vector<TrendRow> rows = RowsToJudge(series, options);
  const std::vector<TrendReason> reasons = CountReasons(rows);
  TrendBlocks blocks = MakeBlocks(*series.device, std::move(rows), options);
  if (blocks.size() < kLeastBlocks || blocks.reference_blocks < 1) {
    return Fail(fmt::format(
        "expected usable measurements at {} times or more, found {}: {} of {} measurements count; "
        "{}",
        kLeastBlocks, blocks.size(), blocks.rows.size(), series.rows.size(),
        reasons.empty() ? std::string(kSideBySide) : ReasonText(reasons.front())));
  }
  TrendReport report = SeriesReport(series, blocks, options);
  report.reasons = reasons;
  TrendParametersFound found = FindParameters(std::move(blocks), series.source, options);
  if (progress.Step()) return Fail("interrupted");
  blocks = WithLosses(std::move(found.blocks), options.threads);
  report.reference_power_W = PowerAt(blocks) * std::exp(-blocks.reference[kModelExcess]);
  report.covered = FindCoveredDays(blocks);
  report.dull_sky_percent = DullSkyPercent(blocks);
  report.quantities = std::move(found.quantities);
  const auto exchange = FindExchange(blocks, report, options.least_onset_percent);
  if (exchange && exchange->certain) {
    const double begin_s = blocks.length_s * std::floor(exchange->time_s / blocks.length_s);
    const TrendSeries first = Until(series, begin_s);
    if (auto of_first = FindTrend(first, options, observer)) {
      of_first->warnings.push_back(ExchangeWarning(*exchange));
      of_first->verdict = of_first->warnings.back() + " " + of_first->verdict;
      return of_first;
    }
  }
  report.quantities = WithPowers(std::move(report.quantities), blocks, series.source, options);
  TrendLosses losses = FindLosses(report.quantities, blocks, series.source, options);
  report.losses = std::move(losses.losses);
  report.loss_days = std::move(losses.days);
  report.quantities =
      WithChangesThatMatter(std::move(report.quantities), blocks, options.least_onset_percent);
  report.onsets = FindOnsets(blocks, report);
  report.verdict = VerdictOf(report, options);
  report.not_decided = NotDecided(report);
  report.warnings = FindWarnings(report);
  if (exchange) report.warnings.push_back(ExchangeWarning(*exchange));
  if (progress.Step()) return Fail("interrupted");
  report.seconds = SecondsSince(start);
  return report;
}

}  // namespace lyrefit
