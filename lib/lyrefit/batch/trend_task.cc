#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "lyrefit/base/try.h"
#include "lyrefit/batch/batch_task.h"
#include "lyrefit/batch/checkpoint.h"
#include "lyrefit/curve/date_time.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json.h"
#include "lyrefit/trend/trend.h"
#include "lyrefit/trend/trend_documents.h"

namespace lyrefit {
namespace {

// A quantity of TrendReport::quantities, with its unit in names of columns.
struct FollowedQuantity {
  const char* name;
  const char* unit;
  const char* suffix;
};

constexpr FollowedQuantity kFollowed[] = {{"p_mp", "%", "percent"},
                                          {"light", "%", "percent"},
                                          {"resistance_series", "ohm", "ohm"},
                                          {"recombination", "V", "V"},
                                          {"second_diode", "%", "percent"},
                                          {"conductance_shunt", "S", "S"},
                                          {"mismatch", "%", "percent"}};

constexpr const char* kLossNames[] = {"light", "resistance_series", "recombination",
                                      "shunt", "mismatch",          "total"};

void AddRangedColumns(const std::string& name, const std::string& unit, const std::string& doc,
                      std::vector<ResultColumn>* columns) {
  columns->push_back({name, unit, CellType::kNumber, doc});
  columns->push_back({name + "_low_95", unit, CellType::kNumber, "its 95 % interval"});
  columns->push_back({name + "_high_95", unit, CellType::kNumber, "its 95 % interval"});
}

void AddLossColumns(const std::string& prefix, const std::string& of,
                    std::vector<ResultColumn>* columns) {
  for (const char* part : kLossNames) {
    const std::string name = fmt::format("{}_{}_percent", prefix, part);
    const bool total = part == std::string("total");
    const std::string doc =
        total ? "all parts of that loss" : fmt::format("lost {}, by {}", of, part);
    if (total) {
      AddRangedColumns(name, "%", doc, columns);
    } else {
      columns->push_back({name, "%", CellType::kNumber, doc});
    }
  }
}

std::vector<ResultColumn> TrendColumns() {
  constexpr CellType kText = CellType::kText;
  constexpr CellType kNumber = CellType::kNumber;
  constexpr CellType kWhole = CellType::kWhole;
  std::vector<ResultColumn> columns = {
      {"first", "", kText, "time of the first measurement"},
      {"last", "", kText, "time of the last measurement"},
      {"measurements", "", kWhole, "sweeps or operating points of the device"},
      {"measurements_used", "", kWhole, "those whose parameters count"},
      {"days", "", kWhole, "days with data"},
      {"reference_power_W", "W", kNumber, "power at 1000 W/m2 and 25 C over the reference days"},
  };
  for (const FollowedQuantity& one : kFollowed) {
    AddRangedColumns(fmt::format("{}_rate_{}", one.name, one.suffix), one.unit,
                     fmt::format("change of {} a year, in {}", one.name, one.unit), &columns);
  }
  AddLossColumns("loss", "of the energy that the reference days let expect", &columns);
  AddLossColumns("loss_now", "of the power over the last 30 days with data", &columns);
  for (ResultColumn column : std::vector<ResultColumn>{
           {"largest_loss", "", kText,
            "the part that takes most over the last 30 days with data, of those whose 95 % "
            "interval "
            "is above zero"},
           {"onsets", "", kWhole, "onsets and steps to the worse"},
           {"cause", "", kText, "what the onset that costs most may be: its id"},
           {"cause_title", "", kText, "the same in a few words"},
           {"cause_about", "", kText, "what it belongs to: device"},
           {"cause_sentence", "", kText, "the same for a technician"},
           {"action", "", kText, "the next thing to do about it"},
           {"onset_date", "", kText, "its day"},
           {"onset_earliest", "", kText, "95 % range of that day"},
           {"onset_latest", "", kText, "95 % range of that day"},
           {"lost_percent", "%", kNumber,
            "of the power, over the last 30 days with data, by what this cause affects"},
           {"recoverable_power_W", "W", kNumber, "the same of the reference power"},
           {"causes", "", kText, "ids of all onsets, by their days"},
           {"verdict", "", kText, "the trend in a few sentences"},
           {"not_decided", "", kText, "what the measurements cannot tell, and what would"},
           {"warnings", "", kText, "in plain words, with '; ' between them"}}) {
    columns.push_back(std::move(column));
  }
  return columns;
}

void AddRanged(const Ranged& one, std::vector<ResultCell>* cells) {
  for (const double value : {one.value, one.low_95, one.high_95}) {
    cells->push_back(NumberCell(value));
  }
}

void AddRates(const TrendReport& report, std::vector<ResultCell>* cells) {
  for (const FollowedQuantity& one : kFollowed) {
    const auto found =
        std::find_if(report.quantities.begin(), report.quantities.end(),
                     [&](const TrendQuantity& quantity) { return quantity.name == one.name; });
    AddRanged(found == report.quantities.end() ? Ranged() : found->rate_per_year, cells);
  }
}

void AddLosses(const TrendReport& report, Ranged TrendLoss::*figure,
               std::vector<ResultCell>* cells) {
  for (const char* part : kLossNames) {
    Ranged loss;
    for (const TrendLoss& one : report.losses) {
      if (one.name == part) loss = one.*figure;
    }
    if (part == std::string("total")) {
      AddRanged(loss, cells);
    } else {
      cells->push_back(NumberCell(loss.value));
    }
  }
}

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
    if (onset.id == cause && counted.insert(onset.quantity).second) lost += onset.lost_percent;
  }
  return lost;
}

// The first onset of the cause that costs most; null: there is none.
const TrendOnset* CostliestOnset(const std::vector<TrendOnset>& onsets) {
  const TrendOnset* costliest = nullptr;
  double most = -kInfinity;
  for (const TrendOnset& onset : onsets) {
    const double lost = LostBy(onset.id, onsets);
    if (costliest != nullptr && !(lost > most)) continue;
    costliest = &onset;
    most = std::isfinite(lost) ? lost : -kInfinity;
  }
  return costliest;
}

ResultCell DateCell(double time_s) {
  return std::isfinite(time_s) ? TextCell(DateText(time_s)) : ResultCell();
}

void AddOnset(const TrendReport& report, std::vector<ResultCell>* cells) {
  const TrendOnset* const found = CostliestOnset(report.onsets);
  const TrendOnset onset = found == nullptr ? TrendOnset() : *found;
  const double lost = found == nullptr ? kUnknown : LostBy(onset.id, report.onsets);
  const double recoverable_W = std::max(lost, 0.0) / 100 * report.reference_power_W;
  std::vector<std::string> ids;
  for (const TrendOnset& one : report.onsets) ids.push_back(one.id);
  for (ResultCell cell : std::vector<ResultCell>{
           static_cast<std::int64_t>(report.onsets.size()), TextCell(onset.id),
           TextCell(onset.cause), found == nullptr ? ResultCell() : TextCell("device"),
           TextCell(onset.what), TextCell(onset.action), DateCell(onset.time_s),
           DateCell(onset.earliest_s), DateCell(onset.latest_s), NumberCell(lost),
           NumberCell(recoverable_W), ListCell(ids), TextCell(report.verdict),
           ListCell(report.not_decided), ListCell(report.warnings, "; ")}) {
    cells->push_back(std::move(cell));
  }
}

std::vector<ResultCell> TrendCells(const TrendReport& report) {
  const auto used = static_cast<std::size_t>(TrendRowState::kUsed);
  std::vector<ResultCell> cells = {TextCell(DateTimeText(report.first_s)),
                                   TextCell(DateTimeText(report.last_s)),
                                   report.rows,
                                   report.states[used],
                                   static_cast<std::int64_t>(report.days),
                                   NumberCell(report.reference_power_W)};
  AddRates(report, &cells);
  AddLosses(report, &TrendLoss::energy_percent, &cells);
  AddLosses(report, &TrendLoss::now_percent, &cells);
  cells.push_back(TextCell(LargestLoss(report)));
  AddOnset(report, &cells);
  return cells;
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
  BatchTaskType task;
  task.name = "trend";
  task.columns = TrendColumns();
  task.options = NonDefaults(options, kTrendOptionTable);
  if (own.law) {
    task.options.push_back({"law", own.law->law + ", " + TextDigest(LawText(*own.law)), ""});
  }
  task.run = [own, options](const BatchCurve& device, std::uint64_t seed,
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
    TaskResult result{RowStatus::kFine, "", TrendCells(*report), stopped};
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
