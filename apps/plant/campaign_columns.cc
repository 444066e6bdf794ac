#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/batch/batch_task.h"
#include "plant/campaign_words.h"

namespace lyrefit {

template <>
struct EnumTable<CampaignKind> {
  static constexpr EnumText<CampaignKind> kRows[] = {
      {CampaignKind::kNone, "none"},
      {CampaignKind::kLight, "light"},
      {CampaignKind::kSubstrings, "substrings"},
      {CampaignKind::kVoltage, "voltage"},
      {CampaignKind::kSeriesResistance, "series_resistance"},
      {CampaignKind::kShuntOrMismatch, "shunt_or_mismatch"},
      {CampaignKind::kFillFactor, "fill_factor"},
      {CampaignKind::kSeveral, "several"},
      {CampaignKind::kPower, "power"},
      {CampaignKind::kMeasurement, "measurement"},
      {CampaignKind::kExchanged, "exchanged"},
      {CampaignKind::kRenamed, "renamed"},
      {CampaignKind::kNew, "new"}};
};

template <>
struct EnumTable<CampaignReference> {
  static constexpr EnumText<CampaignReference> kRows[] = {{CampaignReference::kGroup, "group"},
                                                          {CampaignReference::kPlant, "plant"},
                                                          {CampaignReference::kNothing, "nothing"}};
};

namespace {

CommonChange CommonChangeOf(const CampaignGroup& group) {
  CommonChange common;
  common.name = group.name;
  common.strings = group.strings;
  for (std::size_t q = 0; q < kCampaignFigures.size(); ++q) {
    common.percent[q] = {Percent(group.shift[q]), Percent(group.low[q]), Percent(group.high[q])};
  }
  common.sentence = CommonSentence(
      group, group.name.empty() ? "The plant as a whole" : "All strings of the group");
  return common;
}

void AppendFigureColumns(const std::string& figure, const std::string& of,
                         std::vector<ResultColumn>* columns) {
  const std::string name = fmt::format("change_{}_percent", figure);
  columns->push_back({name, "%", CellType::kNumber, of});
  columns->push_back({name + "_low_95", "%", CellType::kNumber, "its 95 % interval"});
  columns->push_back({name + "_high_95", "%", CellType::kNumber, "its 95 % interval"});
}

}  // namespace

std::vector<ResultColumn> CampaignColumns() {
  constexpr CellType kNumber = CellType::kNumber;
  constexpr CellType kText = CellType::kText;
  std::vector<ResultColumn> columns = {
      {"change_rank", "", CellType::kWhole,
       "place among the strings that changed since the earlier campaign, by watts lost; none: not "
       "changed"},
      {"change_kind", "", kText,
       "what changed: none, light, substrings, voltage, series_resistance, shunt_or_mismatch, "
       "fill_factor, several, power, measurement, exchanged, renamed, new; none at all: not "
       "compared"},
      {"change_candidates", "", kText, "ids of what it may be; the sweeps do not tell them apart"},
      {"change_partner", "", kText, "the string it was exchanged with, or its earlier name"},
      {"change_lost_W", "W", kNumber,
       "power at standard conditions that was lost since the earlier campaign, less what its group "
       "has in common; negative: gained"},
      {"change_lost_W_low_95", "W", kNumber, "its 95 % interval"},
      {"change_lost_W_high_95", "W", kNumber, "its 95 % interval"},
  };
  for (const char* figure : kCampaignFigures) {
    AppendFigureColumns(figure,
                        fmt::format("{} at standard conditions since the earlier campaign, less "
                                    "what its group has in common",
                                    figure),
                        &columns);
  }
  AppendFigureColumns("FF_adjusted",
                      "the same of FF, less what errors of light and temperature move together "
                      "with Isc and Voc; none where Isc or Voc changed",
                      &columns);
  for (const char* figure : kCampaignFigures) {
    columns.push_back({fmt::format("change_common_{}_percent", figure), "%", kNumber,
                       fmt::format("{}: what its group, else the plant, has in common: light, age "
                                   "or a sensor",
                                   figure)});
  }
  columns.push_back(
      {"change_against", "", kText, "whose median is the common change: group, plant, or nothing"});
  columns.push_back({"change_sentence", "", kText, "the change in one sentence"});
  columns.push_back({"change_action", "", kText, "the next thing to do about it"});
  return columns;
}

std::vector<ResultCell> CampaignCells(const Campaign& campaign,
                                      const std::vector<CampaignString>& before,
                                      const std::vector<CampaignString>& after, std::size_t i) {
  const CampaignChange& change = campaign.changes[i];
  const bool has = HasChange(change);
  const ChangeTexts texts = TextsOf(campaign, before, after, i);
  std::vector<ResultCell> cells;
  cells.push_back(change.rank > 0 ? ResultCell(std::int64_t{change.rank}) : ResultCell());
  cells.push_back(change.kind == CampaignKind::kNotCompared ? ResultCell()
                                                            : TextCell(ToText(change.kind)));
  cells.push_back(TextCell(texts.candidates));
  const bool renamed = change.kind == CampaignKind::kRenamed;
  cells.push_back(change.partner < 0 ? ResultCell()
                                     : TextCell((renamed ? before : after)[change.partner].id));
  for (const double watts : {change.lost_W, change.lost_low_W, change.lost_high_W}) {
    cells.push_back(NumberCell(watts));
  }
  for (std::size_t q = 0; q < kCampaignFigures.size(); ++q) {
    const double own = has ? change.own[q] : kUnknown;
    const double half = has ? Half95(change, static_cast<int>(q)) : kUnknown;
    for (const double value : {own, own - half, own + half}) {
      cells.push_back(NumberCell(Percent(value)));
    }
  }
  const bool adjusted = has && change.adjusted;
  const double own = adjusted ? change.own[kAdjustedFill] : kUnknown;
  const double half = adjusted ? Half95(change, kAdjustedFill) : kUnknown;
  for (const double value : {own, own - half, own + half}) {
    cells.push_back(NumberCell(Percent(value)));
  }
  const bool common = has && change.reference != CampaignReference::kNothing;
  for (std::size_t q = 0; q < kCampaignFigures.size(); ++q) {
    cells.push_back(common ? NumberCell(Percent(change.common[q])) : ResultCell());
  }
  cells.push_back(has ? TextCell(ToText(change.reference)) : ResultCell());
  cells.push_back(TextCell(texts.sentence));
  cells.push_back(TextCell(texts.action));
  return cells;
}

CampaignSummary SummariseCampaign(const Campaign& campaign,
                                  const std::vector<CampaignString>& before,
                                  const std::vector<CampaignString>& after) {
  CampaignSummary summary;
  summary.level = campaign.level;
  summary.plant = CommonChangeOf(campaign.plant);
  summary.compared = campaign.plant.strings;
  for (const CampaignGroup& group : campaign.groups) {
    if (group.differs) summary.groups.push_back(CommonChangeOf(group));
  }
  for (std::size_t i = 0; i < after.size(); ++i) {
    const CampaignChange& change = campaign.changes[i];
    const bool fresh = change.kind == CampaignKind::kNew || change.kind == CampaignKind::kRenamed;
    if (fresh) {
      ++summary.fresh;
      if (summary.fresh_ids.size() < kMostChanges) summary.fresh_ids.push_back(after[i].id);
    }
    const auto self = static_cast<std::int32_t>(i);
    if (change.kind == CampaignKind::kExchanged && self < change.partner) {
      summary.exchanged.emplace_back(after[i].id, after[change.partner].id);
    }
    if (change.rank > 0) {
      ++summary.changed;
      (change.lost_W > 0 ? summary.lost_W : summary.gained_W) += std::fabs(change.lost_W);
    }
    const bool listed = change.kind == CampaignKind::kRenamed || change.rank > 0;
    if (!listed || change.rank > static_cast<std::int32_t>(kMostChanges)) continue;
    const ChangeTexts texts = TextsOf(campaign, before, after, i);
    const auto percent = [&](int q) {
      return HasChange(change) ? Percent(change.own[q]) : kUnknown;
    };
    summary.changes.push_back({change.rank, after[i].id, ToText(change.kind), texts.sentence,
                               texts.candidates, texts.action, percent(kCIsc), percent(kCVoc),
                               percent(change.adjusted ? int{kAdjustedFill} : int{kCFillFactor}),
                               change.lost_W, change.lost_low_W, change.lost_high_W});
  }
  std::stable_sort(summary.changes.begin(), summary.changes.end(),
                   [](const StringChange& one, const StringChange& other) {
                     const auto last = [](std::int64_t rank) { return rank == 0 ? 1 : 0; };
                     return std::pair(last(one.rank), one.rank) <
                            std::pair(last(other.rank), other.rank);
                   });
  summary.gone = static_cast<std::int64_t>(campaign.gone.size());
  summary.not_repeated = campaign.not_repeated;
  for (const std::int32_t k : campaign.gone) {
    if (summary.gone_ids.size() < kMostChanges) summary.gone_ids.push_back(before[k].id);
  }
  return summary;
}

}  // namespace lyrefit
