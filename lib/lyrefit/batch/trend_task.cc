#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "lyrefit/base/append.h"
#include "lyrefit/base/try.h"
#include "lyrefit/batch/checkpoint.h"
#include "lyrefit/batch/column.h"
#include "lyrefit/curve/date_time.h"
#include "lyrefit/trend/trend.h"
#include "lyrefit/trend/trend_documents.h"

namespace lyrefit {
namespace {

// The name of the part that takes most now, of those that are shown to take anything; or empty.
std::string LargestLoss(const TrendReport& report) {
  std::string largest;
  double most = 0;
  for (const TrendLoss& loss : report.losses) {
    const Ranged& now = loss.now_percent;
    if (loss.name == "total" || !(now.low_95 > 0) || !(now.value > most)) continue;
    most = now.value;
    largest = loss.name;
  }
  return largest;
}

// What a cause costs now, in percent: the parts of all quantities in which it began.
double LostBy(const std::string& cause, const std::vector<TrendOnset>& onsets) {
  std::set<std::string> counted;
  double lost = 0;
  for (const TrendOnset& onset : onsets) {
    if (onset.cause.id != cause || !counted.insert(onset.quantity).second) continue;
    lost += onset.lost_percent;
  }
  return lost;
}

// The first onset of the cause that costs most; null: there is none.
const TrendOnset* CostliestOnset(const std::vector<TrendOnset>& onsets) {
  const TrendOnset* costliest = nullptr;
  double most = -kInfinity;
  for (const TrendOnset& onset : onsets) {
    const double lost = LostBy(onset.cause.id, onsets);
    if (costliest != nullptr && !(lost > most)) continue;
    costliest = &onset;
    most = std::isfinite(lost) ? lost : -kInfinity;
  }
  return costliest;
}

struct TrendFigures {
  explicit TrendFigures(const TrendReport& of) : report(of) {
    const TrendOnset* const found = CostliestOnset(of.onsets);
    if (found == nullptr) return;
    onset = *found;
    lost_percent = LostBy(onset.cause.id, of.onsets);
  }

  const TrendReport& report;
  TrendOnset onset = {};  // that costs most; empty: there is none
  double lost_percent = kUnknown;
};

std::string DayText(double time_s) { return std::isfinite(time_s) ? DateText(time_s) : ""; }

void AddRates(ColumnList<TrendFigures>* columns) {
  struct Followed {  // a quantity of TrendReport::quantities, with its unit in names of columns
    const char* name;
    const char* unit;
    const char* suffix;
  };
  for (const auto& [name, unit, suffix] : {Followed{"p_mp", "%", "percent"},
                                           {"light", "%", "percent"},
                                           {"resistance_series", "ohm", "ohm"},
                                           {"recombination", "V", "V"},
                                           {"second_diode", "%", "percent"},
                                           {"conductance_shunt", "S", "S"},
                                           {"mismatch", "%", "percent"}}) {
    AddRanged(
        fmt::format("{}_rate_{}", name, suffix), unit,
        fmt::format("change of {} a year, in {}", name, unit),
        [name = std::string(name)](const TrendFigures& of) {
          for (const TrendQuantity& one : of.report.quantities) {
            if (one.name == name) return one.rate_per_year;
          }
          return Ranged();
        },
        columns);
  }
}

void AddLosses(const std::string& prefix, const std::string& of, Ranged TrendLoss::*figure,
               ColumnList<TrendFigures>* columns) {
  const auto part_of = [figure](const std::string& part) {
    return [figure, part](const TrendFigures& row) {
      Ranged loss;
      for (const TrendLoss& one : row.report.losses) {
        if (one.name == part) loss = one.*figure;
      }
      return loss;
    };
  };
  for (const char* part : {"light", "resistance_series", "recombination", "shunt", "mismatch"}) {
    columns->emplace_back(
        fmt::format("{}_{}_percent", prefix, part), "%", fmt::format("lost {}, by {}", of, part),
        [ranged = part_of(part)](const TrendFigures& row) { return ranged(row).value; });
  }
  AddRanged(prefix + "_total_percent", "%", "all parts of that loss", part_of("total"), columns);
}

ColumnList<TrendFigures> TrendColumns() {
  using Of = const TrendFigures&;
  ColumnList<TrendFigures> columns = {
      {"first", "", "time of the first measurement",
       [](Of of) { return DateTimeText(of.report.first_s); }},
      {"last", "", "time of the last measurement",
       [](Of of) { return DateTimeText(of.report.last_s); }},
      {"measurements", "", "sweeps or operating points of the device",
       [](Of of) { return of.report.rows; }},
      {"measurements_used", "", "those whose parameters count",
       [](Of of) { return of.report.states[static_cast<std::size_t>(TrendRowState::kUsed)]; }},
      {"days", "", "days with data", [](Of of) { return of.report.days; }},
      {"reference_power_W", "W", "power at 1000 W/m2 and 25 C over the reference days",
       [](Of of) { return of.report.reference_power_W; }},
  };
  AddRates(&columns);
  AddLosses("loss", "of the energy that the reference days let expect", &TrendLoss::energy_percent,
            &columns);
  AddLosses("loss_now", "of the power over the last 30 days with data", &TrendLoss::now_percent,
            &columns);
  Append(
      {{"largest_loss", "",
        "the part that takes most over the last 30 days with data, of those whose 95 % interval "
        "is above zero",
        [](Of of) { return LargestLoss(of.report); }},
       {"onsets", "", "onsets and steps to the worse",
        [](Of of) { return of.report.onsets.size(); }},
       {"cause", "", "what the onset that costs most may be: its id",
        [](Of of) { return of.onset.cause.id; }},
       {"cause_title", "", "the same in a few words", [](Of of) { return of.onset.cause.title; }},
       {"cause_about", "", "what it belongs to: device",
        [](Of of) { return of.onset.cause.group; }},
       {"cause_sentence", "", "the same for a technician",
        [](Of of) { return of.onset.cause.sentence; }},
       {"action", "", "the next thing to do about it", [](Of of) { return of.onset.cause.action; }},
       {"onset_date", "", "its day", [](Of of) { return DayText(of.onset.time_s); }},
       {"onset_earliest", "", "95 % range of that day",
        [](Of of) { return DayText(of.onset.earliest_s); }},
       {"onset_latest", "", "95 % range of that day",
        [](Of of) { return DayText(of.onset.latest_s); }},
       {"lost_percent", "%",
        "of the power, over the last 30 days with data, by what this cause affects",
        &TrendFigures::lost_percent},
       {"recoverable_power_W", "W", "the same of the reference power",
        [](Of of) { return std::max(of.lost_percent, 0.0) / 100 * of.report.reference_power_W; }},
       {"causes", "", "ids of all onsets, by their days",
        [](Of of) {
          std::vector<std::string> ids;
          for (const TrendOnset& one : of.report.onsets) ids.push_back(one.cause.id);
          return ListCell(ids);
        }},
       {"verdict", "", "the trend in a few sentences", [](Of of) { return of.report.verdict; }},
       {"not_decided", "", "what the measurements cannot tell, and what would",
        [](Of of) { return ListCell(of.report.not_decided); }},
       {"warnings", "", "in plain words, with '; ' between them",
        [](Of of) { return ListCell(of.report.warnings, "; "); }}},
      &columns);
  return columns;
}

Expected<TrendSeries> SeriesOfFile(const std::string& file, const TrendReadOptions& reading,
                                   const TrendOptions& options, const Observer& observer) {
  if (IsTrendState(file)) return ReadTrendState(file);
  const bool points = reading.law && reading.law->source == TrendSource::kOperatingPoints;
  if (points) return ReadOperatingPoints({file}, reading);
  return ReadTrend({file}, reading, options, observer);
}

Expected<TrendReport> TrendOfFile(const BatchCurve& device, const TrendReadOptions& reading,
                                  const TrendOptions& options, const Observer& observer) {
  TRY(TrendSeries series, SeriesOfFile(device.file, reading, options, observer));
  series.name = device.id;
  TRY(TrendReport report, FindTrend(series, options, observer));
  report.seconds = kUnknown;  // a page must not depend on the time used
  return report;
}

}  // namespace

BatchTaskType TrendTask(const TrendReadOptions& reading, const TrendOptions& asked) {
  TrendReadOptions own = reading;
  own.reading.shard = {};
  own.reading.reading.whole_files = false;
  TrendOptions options = asked;
  options.threads = 1;
  const ColumnList<TrendFigures> columns = TrendColumns();
  BatchTaskType task;
  task.name = "trend";
  task.columns = HeadsOf(columns);
  task.options = NonDefaults(options, kTrendOptionTable);
  if (own.law) {
    task.options.push_back({"law", own.law->law + ", " + TextDigest(LawText(*own.law)), ""});
  }
  task.run = [own, options, columns](const BatchCurve& device, std::uint64_t seed,
                                     const Observer& observer) {
    TrendOptions seeded = options;
    seeded.seed = seed;
    bool stopped = false;
    const Observer watched = [&](const Progress& progress) {
      stopped = stopped || StopRequested(observer, progress);
      return stopped ? ObserverAction::kStop : ObserverAction::kContinue;
    };
    auto report = TrendOfFile(device, own, seeded, watched);
    if (!report) return TaskResult{RowStatus::kBroken, report.error().message, {}, stopped};
    TaskResult result{RowStatus::kFine, "", CellsOf(columns, TrendFigures(*report)), stopped};
    result.failed = !report->onsets.empty();
    result.page = [report = std::make_shared<const TrendReport>(std::move(*report))](
                      const PageOptions& page) {
      return DrawPage(TrendDocument(*report), TrendJson(*report), page);
    };
    return result;
  };
  return task;
}

}  // namespace lyrefit
