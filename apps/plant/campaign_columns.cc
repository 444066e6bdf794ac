#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "lyrefit/base/append.h"
#include "lyrefit/base/enum_text.h"
#include "lyrefit/batch/column.h"
#include "plant/campaign_words.h"

namespace lyrefit {

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

struct CampaignRow {
  const CampaignChange& change;
  Cause cause;
  std::string partner;  // its id

  // The own change of a ratio in percent.
  Ranged Own(int q) const {
    if (!HasChange(change)) return {};
    const double own = change.own[q];
    const double half = Half95(change, q);
    return {Percent(own), Percent(own - half), Percent(own + half)};
  }
};

ColumnList<CampaignRow> ChangeColumns() {
  using Of = const CampaignRow&;
  ColumnList<CampaignRow> columns = {
      {"change_rank", "",
       "place among the strings that changed since the earlier campaign, by watts lost; none: not "
       "changed",
       [](Of of) { return of.change.rank > 0 ? std::optional(of.change.rank) : std::nullopt; }},
      {"change_kind", "",
       "what changed: none, light, substrings, temperature, series_resistance, shunt, mismatch, "
       "other_modules, "
       "measurement, exchanged, renamed, new; of several that the sweeps do not tell apart: "
       "voltage, "
       "shunt_or_mismatch, fill_factor, several; none at all: not compared",
       [](Of of) { return of.cause.id; }},
      {"change_candidates", "", "ids of what it may be, the most probable first",
       [](Of of) { return ListCell(of.cause.equivalents, " "); }},
      {"change_probability", "", "of the most probable mechanism against the others",
       [](Of of) { return of.cause.probability; }},
      {"change_partner", "", "the string it was exchanged with, or its earlier name",
       &CampaignRow::partner},
  };
  AddRanged(
      "change_lost_W", "W",
      "power at standard conditions that was lost since the earlier campaign, less what its group "
      "has in common; negative: gained",
      [](Of of) {
        const Sized& lost = of.cause.recoverable_power_W;
        return Ranged{lost.value, lost.low_95, lost.high_95};
      },
      &columns);
  const int figures = static_cast<int>(kCampaignFigures.size());
  for (int q = 0; q < figures; ++q) {
    AddRanged(
        fmt::format("change_{}_percent", kCampaignFigures[q]), "%",
        fmt::format("{} at standard conditions since the earlier campaign, less what its "
                    "group has in common",
                    kCampaignFigures[q]),
        [q](Of of) { return of.Own(q); }, &columns);
  }
  AddRanged(
      "change_FF_adjusted_percent", "%",
      "the same of FF, less what errors of light and temperature move together with Isc and Voc; "
      "none where Isc or Voc changed",
      [](Of of) { return of.change.adjusted ? of.Own(kAdjustedFill) : Ranged(); }, &columns);
  for (int q = 0; q < figures; ++q) {
    columns.emplace_back(
        fmt::format("change_common_{}_percent", kCampaignFigures[q]), "%",
        fmt::format("{}: what its group, else the plant, has in common: light, age or a sensor",
                    kCampaignFigures[q]),
        [q](Of of) {
          const bool common =
              HasChange(of.change) && of.change.reference != CampaignReference::kNothing;
          return common ? Percent(of.change.common[q]) : kUnknown;
        });
  }
  Append({{"change_against", "", "whose median is the common change: group, plant, or nothing",
           [](Of of) { return HasChange(of.change) ? ToText(of.change.reference) : ""; }},
          {"change_sentence", "", "the change in one sentence",
           [](Of of) { return of.cause.sentence; }},
          {"change_action", "", "the next thing to do about it",
           [](Of of) { return of.cause.action; }}},
         &columns);
  return columns;
}

}  // namespace

std::vector<ResultColumn> CampaignColumns() { return HeadsOf(ChangeColumns()); }

std::vector<ResultCell> CampaignCells(const Campaign& campaign,
                                      const std::vector<CampaignString>& before,
                                      const std::vector<CampaignString>& after, std::size_t i) {
  static const ColumnList<CampaignRow> columns = ChangeColumns();
  const CampaignChange& change = campaign.changes[i];
  const std::vector<CampaignString>& partners =
      change.kind == CampaignKind::kRenamed ? before : after;
  return CellsOf(columns, CampaignRow{change, CauseOf(campaign, before, after, i),
                                      change.partner < 0 ? "" : partners[change.partner].id});
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
    const auto percent = [&](int q) {
      return HasChange(change) ? Percent(change.own[q]) : kUnknown;
    };
    summary.changes.push_back({change.rank, after[i].id, CauseOf(campaign, before, after, i),
                               percent(kCIsc), percent(kCVoc),
                               percent(change.adjusted ? int{kAdjustedFill} : int{kCFillFactor})});
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
