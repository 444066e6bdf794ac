#include "plant/samples.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/quantile.h"
#include "lyrefit/batch/batch_task.h"
#include "lyrefit/batch/count_rows.h"
#include "lyrefit/batch/pixel_state.h"
#include "lyrefit/batch/row_text.h"
#include "lyrefit/read/cells.h"
#include "plant/sample_document.h"

namespace lyrefit {
namespace {

constexpr std::array<const char*, 2> kDirections = {"forward", "reverse"};
constexpr std::size_t kEfficiency = 0, kPower = 4;  // among kSampleQuantities

constexpr char kSamplesCsv[] = "samples.csv";
constexpr char kSamplesLines[] = "samples.jsonl";

std::string TextIn(const ResultRow& row, std::size_t place) {
  const auto* const text = CellAt<std::string>(row, place);
  return text == nullptr ? std::string() : *text;
}

double NumberIn(const ResultRow& row, std::size_t place) {
  const auto* const number = CellAt<double>(row, place);
  return number == nullptr ? kUnknown : *number;
}

Quartiles QuartilesOf(std::vector<double> values) {
  Quartiles found;
  if (values.empty()) return found;
  std::sort(values.begin(), values.end());
  found.count = static_cast<std::int64_t>(values.size());
  found.low = Quantile(values, 0.25);
  found.median = Quantile(values, 0.5);
  found.high = Quantile(values, 0.75);
  return found;
}

std::int64_t CountOf(const std::map<std::string, std::int64_t>& counts, const std::string& name) {
  const auto found = counts.find(name);
  return found == counts.end() ? 0 : found->second;
}

}  // namespace

std::int64_t SampleSummary::working() const {
  return CountOf(states, ToText(PixelState::kWorking));
}

double SampleSummary::yield() const {
  const std::int64_t lit = pixels - CountOf(states, ToText(PixelState::kUnlit));
  return lit == 0 ? kUnknown : static_cast<double>(working()) / static_cast<double>(lit);
}

SampleCounter::SampleCounter(const std::vector<ResultColumn>& columns)
    : id_(ColumnPlace(columns, "id")),
      where_(ColumnPlace(columns, "where")),
      status_(ColumnPlace(columns, "status")),
      state_(ColumnPlace(columns, "state")),
      sense_(ColumnPlace(columns, "hysteresis")),
      at_(),
      counts_(ColumnPlace(columns, "sample") != kNoColumn && state_ != kNoColumn) {
  for (std::size_t d = 0; d < kDirections.size(); ++d) {
    for (std::size_t q = 0; q < kSampleQuantities.size(); ++q) {
      const std::string name = std::string(kDirections[d]) + "_" + kSampleQuantities[q];
      at_[d].quantities[q] = ColumnPlace(columns, name.c_str());
    }
  }
}

void SampleCounter::Count(const ResultRow& row) {
  const std::string id = TextIn(row, id_);
  const std::string name = SampleOfCell(id, TextIn(row, where_));
  const auto [place, is_new] = places_.emplace(name, samples_.size());
  if (is_new) samples_.push_back({{name, 0, {}, {}, {}, {}}, {}});
  Sample& sample = samples_[place->second];
  ++sample.summary.pixels;
  std::string state = TextIn(row, state_);
  if (state.empty()) state = ToText(PixelState::kBroken);
  if (TextIn(row, status_) == ToText(RowStatus::kDoubtful)) state = ToText(PixelState::kDoubtful);
  ++sample.summary.states[state];
  if (state != ToText(PixelState::kWorking)) {
    sample.summary.not_working.push_back(id.substr(id.rfind('/') + 1) + ": " + state);
    return;
  }
  const std::string sense = TextIn(row, sense_);
  if (!sense.empty()) ++sample.summary.senses[sense];
  for (std::size_t d = 0; d < kDirections.size(); ++d) {
    CountDirection(row, id, at_[d], &sample.directions[d]);
  }
}

void SampleCounter::CountDirection(const ResultRow& row, const std::string& id,
                                   const DirectionPlaces& at, Direction* direction) const {
  for (std::size_t q = 0; q < kSampleQuantities.size(); ++q) {
    const double value = NumberIn(row, at.quantities[q]);
    if (std::isfinite(value)) direction->values[q].push_back(value);
  }
  SampleDirection& found = direction->found;
  const double efficiency = NumberIn(row, at.quantities[kEfficiency]);
  const double power_W = NumberIn(row, at.quantities[kPower]);
  if (!std::isfinite(power_W)) return;
  const bool by_efficiency = std::isfinite(efficiency) || std::isfinite(found.champion_efficiency);
  const bool better = by_efficiency
                          ? !(efficiency <= found.champion_efficiency) && std::isfinite(efficiency)
                          : power_W > found.champion_pmp_W;
  if (!found.champion.empty() && !better) return;
  found.champion = id;
  found.champion_efficiency = efficiency;
  found.champion_pmp_W = power_W;
}

std::vector<SampleSummary> SampleCounter::Summaries() const {
  std::vector<SampleSummary> summaries;
  for (const Sample& sample : samples_) {
    summaries.push_back(sample.summary);
    for (std::size_t d = 0; d < kDirections.size(); ++d) {
      if (sample.directions[d].values[kPower].empty()) continue;
      SampleDirection found = sample.directions[d].found;
      found.direction = kDirections[d];
      for (std::size_t q = 0; q < kSampleQuantities.size(); ++q) {
        found.quantities[q] = QuartilesOf(sample.directions[d].values[q]);
      }
      summaries.back().directions.push_back(std::move(found));
    }
  }
  return summaries;
}

std::vector<ResultColumn> SampleColumns() {
  constexpr CellType kText = CellType::kText;
  constexpr CellType kNumber = CellType::kNumber;
  constexpr CellType kWhole = CellType::kWhole;
  std::vector<ResultColumn> columns = {
      {"sample", "", kText, "the sample"},
      {"direction", "", kText, "forward or reverse; none where no pixel works"},
      {"pixels", "", kWhole, "all pixels of the sample, of any direction"},
      {"working", "", kWhole, "those that work"},
      {"shorted", "", kWhole, "those that are shorted"},
      {"dead", "", kWhole, "those that give no current"},
      {"weak", "", kWhole, "those below the least efficiency"},
      {"unlit", "", kWhole, "those measured in the dark only, which the yield leaves out"},
      {"doubtful", "", kWhole, "those of implausible readings"},
      {"broken", "", kWhole, "those that could not be read"},
      {"yield", "", kNumber, "working over all that were measured in the light, a fraction"},
      {"not_working", "", kText, "pixels that do not work, with '; ' between them"},
      {"hysteresis_normal", "", kWhole, "working pixels whose reverse sweep gives more power"},
      {"hysteresis_inverted", "", kWhole, "working pixels whose forward sweep gives more power"},
      {"count", "", kWhole, "working pixels measured in this direction"},
  };
  for (const char* quantity : kSampleQuantities) {
    const std::string name = quantity;
    columns.push_back({name + "_q1", "", kNumber, "lower quartile of the working pixels"});
    columns.push_back({name + "_median", "", kNumber, "median of the working pixels"});
    columns.push_back({name + "_q3", "", kNumber, "upper quartile of the working pixels"});
  }
  columns.push_back({"champion", "", kText, "id of the best pixel in this direction"});
  columns.push_back({"champion_efficiency", "", kNumber, "its efficiency, a fraction"});
  columns.push_back({"champion_pmp_W", "W", kNumber, "its maximum power"});
  return columns;
}

std::vector<ResultRow> SampleRows(const std::vector<SampleSummary>& samples) {
  std::vector<ResultRow> rows;
  for (const SampleSummary& sample : samples) {
    std::vector<SampleDirection> directions = sample.directions;
    if (directions.empty()) directions.emplace_back();
    for (const SampleDirection& one : directions) {
      ResultRow row = {{TextCell(sample.name), TextCell(one.direction), sample.pixels}};
      for (const PixelState state :
           {PixelState::kWorking, PixelState::kShorted, PixelState::kDead, PixelState::kWeak,
            PixelState::kUnlit, PixelState::kDoubtful, PixelState::kBroken}) {
        row.cells.emplace_back(CountOf(sample.states, ToText(state)));
      }
      row.cells.push_back(NumberCell(sample.yield()));
      row.cells.push_back(ListCell(sample.not_working, "; "));
      row.cells.emplace_back(CountOf(sample.senses, ToText(HysteresisSense::kNormal)));
      row.cells.emplace_back(CountOf(sample.senses, ToText(HysteresisSense::kInverted)));
      row.cells.emplace_back(one.quantities[kPower].count);
      for (const Quartiles& quantity : one.quantities) {
        for (const double value : {quantity.low, quantity.median, quantity.high}) {
          row.cells.push_back(NumberCell(value));
        }
      }
      row.cells.push_back(TextCell(one.champion));
      row.cells.push_back(NumberCell(one.champion_efficiency));
      row.cells.push_back(NumberCell(one.champion_pmp_W));
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

std::vector<std::string> SampleAddition::FileNames() const { return {kSamplesCsv, kSamplesLines}; }

Expected<void> SampleAddition::Open(const RowsInput& input) {
  const BatchJson& options = input.head.at("options");
  counter_ = SampleCounter(input.columns);
  if (!counter_->counts()) counter_.reset();
  working_pixel_ = options.value(kPixelCriterion, "");
  texts_ = options.value("raw-csv", false) ? CsvTexts::kRaw : CsvTexts::kSafe;
  return {};
}

Expected<void> SampleAddition::Add(RowGroup* group) {
  if (!counter_) return {};
  for (const ResultRow& row : group->rows) counter_->Count(row);
  return {};
}

AddedReport SampleAddition::Report() const {
  AddedReport report;
  if (!counter_) return report;
  const std::vector<SampleSummary> samples = counter_->Summaries();
  report.sections = SampleSections(samples, working_pixel_);
  if (results_ != nullptr) {
    results_->samples = samples;
    results_->working_pixel = working_pixel_;
  }
  return report;
}

std::vector<ResultFile> SampleAddition::Files() const {
  if (!counter_) return {};
  const std::vector<ResultColumn> columns = SampleColumns();
  ResultFile csv = {kSamplesCsv, HeadCsv(columns)};
  ResultFile lines = {kSamplesLines, ""};
  for (const ResultRow& row : SampleRows(counter_->Summaries())) {
    csv.text += RowCsv(row, texts_);
    lines.text += RowJson(columns, row) + "\n";
  }
  return {csv, lines};
}

void SampleAddition::AddToSchema(BatchJson* schema) const {
  if (counter_) (*schema)["samples"] = {{"fields", FieldsJson(SampleColumns())}};
}

}  // namespace lyrefit
