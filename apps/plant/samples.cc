#include "plant/samples.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/append.h"
#include "lyrefit/base/median.h"
#include "lyrefit/batch/column.h"
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

// A row of samples.csv and samples.jsonl.
struct SampleRow {
  const SampleSummary& sample;
  SampleDirection direction;  // empty: no pixel works
};

void AddStates(ColumnList<SampleRow>* columns) {
  for (const auto& [state, doc] :
       {std::pair{PixelState::kWorking, "those that work"},
        {PixelState::kShorted, "those that are shorted"},
        {PixelState::kDead, "those that give no current"},
        {PixelState::kWeak, "those below the least efficiency"},
        {PixelState::kUnlit, "those measured in the dark only, which the yield leaves out"},
        {PixelState::kDoubtful, "those of implausible readings"},
        {PixelState::kBroken, "those that could not be read"}}) {
    columns->emplace_back(ToText(state), "", doc, [name = ToText(state)](const SampleRow& of) {
      return CountOf(of.sample.states, name);
    });
  }
}

void AddQuartiles(std::size_t q, ColumnList<SampleRow>* columns) {
  const auto add = [&](const char* end, const char* what, double Quartiles::*figure) {
    columns->emplace_back(
        std::string(kSampleQuantities[q]) + end, "", std::string(what) + " of the working pixels",
        [q, figure](const SampleRow& of) { return of.direction.quantities[q].*figure; });
  };
  add("_q1", "lower quartile", &Quartiles::low);
  add("_median", "median", &Quartiles::median);
  add("_q3", "upper quartile", &Quartiles::high);
}

ColumnList<SampleRow> SampleColumns() {
  using Of = const SampleRow&;
  ColumnList<SampleRow> columns = {
      {"sample", "", "the sample", [](Of of) { return of.sample.name; }},
      {"direction", "", "forward or reverse; none where no pixel works",
       [](Of of) { return of.direction.direction; }},
      {"pixels", "", "all pixels of the sample, of any direction",
       [](Of of) { return of.sample.pixels; }},
  };
  AddStates(&columns);
  Append({{"yield", "", "working over all that were measured in the light, a fraction",
           [](Of of) { return of.sample.yield(); }},
          {"not_working", "", "pixels that do not work, with '; ' between them",
           [](Of of) { return ListCell(of.sample.not_working, "; "); }},
          {"hysteresis_normal", "", "working pixels whose reverse sweep gives more power",
           [](Of of) { return CountOf(of.sample.senses, ToText(HysteresisSense::kNormal)); }},
          {"hysteresis_inverted", "", "working pixels whose forward sweep gives more power",
           [](Of of) { return CountOf(of.sample.senses, ToText(HysteresisSense::kInverted)); }},
          {"count", "", "working pixels measured in this direction",
           [](Of of) { return of.direction.quantities[kPower].count; }}},
         &columns);
  for (std::size_t q = 0; q < kSampleQuantities.size(); ++q) AddQuartiles(q, &columns);
  Append({{"champion", "", "id of the best pixel in this direction",
           [](Of of) { return of.direction.champion; }},
          {"champion_efficiency", "", "its efficiency, a fraction",
           [](Of of) { return of.direction.champion_efficiency; }},
          {"champion_pmp_W", "W", "its maximum power",
           [](Of of) { return of.direction.champion_pmp_W; }}},
         &columns);
  return columns;
}

}  // namespace

std::int64_t SampleSummary::working() const {
  return CountOf(states, ToText(PixelState::kWorking));
}

double SampleSummary::yield() const {
  const std::int64_t lit = pixels - CountOf(states, ToText(PixelState::kUnlit));
  return lit == 0 ? kUnknown : static_cast<double>(working()) / static_cast<double>(lit);
}

void SampleCounter::Count(const ResultRow& row) {
  const std::string id = reader_.Text(row, "id");
  const std::string name = SampleOfCell(id, reader_.Text(row, "where"));
  const auto [place, is_new] = places_.emplace(name, samples_.size());
  if (is_new) samples_.push_back({{name, 0, {}, {}, {}, {}}, {}});
  Sample& sample = samples_[place->second];
  ++sample.summary.pixels;
  std::string state = reader_.Text(row, "state");
  if (state.empty()) state = ToText(PixelState::kBroken);
  if (reader_.Text(row, "status") == ToText(RowStatus::kDoubtful))
    state = ToText(PixelState::kDoubtful);
  ++sample.summary.states[state];
  if (state != ToText(PixelState::kWorking)) {
    sample.summary.not_working.push_back(id.substr(id.rfind('/') + 1) + ": " + state);
    return;
  }
  const std::string sense = reader_.Text(row, "hysteresis");
  if (!sense.empty()) ++sample.summary.senses[sense];
  for (std::size_t d = 0; d < kDirections.size(); ++d) {
    CountDirection(row, id, std::string(kDirections[d]) + "_", &sample.directions[d]);
  }
}

void SampleCounter::CountDirection(const ResultRow& row, const std::string& id,
                                   const std::string& prefix, Direction* direction) const {
  const auto number = [&](std::size_t q) {
    return reader_.Number(row, prefix + kSampleQuantities[q]);
  };
  for (std::size_t q = 0; q < kSampleQuantities.size(); ++q) {
    if (std::isfinite(number(q))) direction->values[q].push_back(number(q));
  }
  SampleDirection& found = direction->found;
  const double efficiency = number(kEfficiency);
  const double power_W = number(kPower);
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
  const ColumnList<SampleRow> columns = SampleColumns();
  const std::vector<ResultColumn> heads = HeadsOf(columns);
  ResultFile csv = {kSamplesCsv, HeadCsv(heads)};
  ResultFile lines = {kSamplesLines, ""};
  for (const SampleSummary& sample : counter_->Summaries()) {
    std::vector<SampleDirection> directions = sample.directions;
    if (directions.empty()) directions.emplace_back();
    for (SampleDirection& one : directions) {
      const ResultRow row = {CellsOf(columns, SampleRow{sample, std::move(one)})};
      csv.text += RowCsv(row, texts_);
      lines.text += RowJson(heads, row) + "\n";
    }
  }
  return {csv, lines};
}

void SampleAddition::AddToSchema(BatchJson* schema) const {
  if (counter_) (*schema)["samples"] = {{"fields", FieldsJson(HeadsOf(SampleColumns()))}};
}

}  // namespace lyrefit
