#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lyrefit/base/distributions.h"
#include "lyrefit/base/enum_text.h"
#include "lyrefit/batch/batch_task.h"
#include "lyrefit/batch/campaign.h"

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

// What a kind may come from, and what to do: for a loss and for a gain. Candidates are ids of
// effects, and missing_module, other_module, dirt_removed, repair.
struct KindWords {
  CampaignKind kind;
  const char* candidates;
  const char* what;    // of a loss
  const char* action;  // of a loss
  const char* gained_candidates;
  const char* gained;
};

constexpr char kNote[] = "Note what was done to the string; nothing else to do.";

constexpr KindWords kKindWords[] = {
    {CampaignKind::kLight, "soiling shading sensor_offset",
     "less current, the rest as before: dirt or shade on all modules alike, or a sensor that "
     "read more light than there was; one sweep does not tell which",
     "Look for dirt and shade; if there is none, repeat the sweep with the sensor beside the "
     "modules.",
     "cleaning sensor_offset",
     "more current, the rest as before: cleaned modules, or a sensor that read less light than "
     "there was"},
    {CampaignKind::kSubstrings, "bypass_short missing_module",
     "the voltage of whole groups of cells is missing, the rest as before",
     "Count the modules of the string, then measure the voltage of each.", "repair",
     "the voltage of whole groups of cells came back"},
    {CampaignKind::kVoltage, "bypass_short missing_module temperature_or_cells temp_offset",
     "less voltage, the rest as before: warmer cells than stated, or cells that are bypassed or "
     "degraded",
     "Repeat the sweep with a temperature sensor behind a module of the string.",
     "temperature_or_cells temp_offset repair",
     "more voltage, the rest as before: cooler cells than stated, or a repair"},
    {CampaignKind::kSeriesResistance, "series_resistance",
     "the voltage at maximum power fell: series resistance grew, of a connector, a cable or a "
     "junction box",
     "Look at connectors and junction boxes under load with an infrared camera.", "repair",
     "the voltage at maximum power rose: series resistance fell"},
    {CampaignKind::kShuntOrMismatch, "shunt mismatch shading",
     "the current at maximum power fell more than the short-circuit current: shunts, or modules "
     "that no longer match (shade, uneven dirt, another type, a cracked cell)",
     "Look for shade and uneven dirt; then sweep the modules one by one.", "repair cleaning",
     "the current at maximum power rose: shade, dirt or shunts went"},
    {CampaignKind::kFillFactor, "series_resistance shunt mismatch shading",
     "less fill factor: resistance, shunts or mismatch; the figures do not tell which",
     "Sweep again at another light: resistance costs more in strong light, shunts in weak.",
     "repair cleaning", "more fill factor"},
    {CampaignKind::kSeveral, "other_module mismatch shading shunt bypass_short soiling",
     "several figures fell at once", "Look at the string; then sweep its modules one by one.",
     "repair cleaning other_module", "several figures changed at once, with more power"},
    {CampaignKind::kPower, "soiling shading series_resistance sensor_offset",
     "less power, while no single figure fell by more than is usual", "Repeat the sweep.",
     "cleaning repair sensor_offset", "more power, while no single figure rose"},
};

const KindWords* WordsOf(CampaignKind kind) {
  for (const KindWords& words : kKindWords) {
    if (words.kind == kind) return &words;
  }
  return nullptr;
}

double Percent(double logarithm) { return 100 * std::expm1(logarithm); }

double Half95(const CampaignChange& change, int q) {
  return StudentQuantile(0.975, change.degrees) * change.sigma[q];
}

bool HasChange(const CampaignChange& change) {
  return change.before >= 0 && change.why_not.empty();
}

// "Isc -2.1 %, FF +0.3 %" of the figures.
std::string FiguresText(const CampaignChange& change) {
  std::string text;
  for (std::size_t q = 0; q < kCampaignFigures.size(); ++q) {
    const int place = static_cast<int>(q);
    text += fmt::format("{}{} {:+.2f} % [{:+.2f}, {:+.2f}]", text.empty() ? "" : ", ",
                        kCampaignFigures[q], Percent(change.own[q]),
                        Percent(change.own[q] - Half95(change, place)),
                        Percent(change.own[q] + Half95(change, place)));
  }
  if (change.adjusted) {
    const double half = Half95(change, kAdjustedFill);
    text += fmt::format(
        ", FF adjusted {:+.2f} % [{:+.2f}, {:+.2f}]", Percent(change.own[kAdjustedFill]),
        Percent(change.own[kAdjustedFill] - half), Percent(change.own[kAdjustedFill] + half));
  }
  return text;
}

std::string StepText(const CampaignChange& change, const CampaignString& after) {
  if (change.kind != CampaignKind::kSubstrings) return "";
  const int one = std::abs(change.steps_low), other = std::abs(change.steps_high);
  const int least = std::min(one, other), most = std::max(one, other);
  return fmt::format("; of {} bypass diodes {} {} of these groups", after.bypass_diodes,
                     least == most ? std::to_string(least) : fmt::format("{} to {}", least, most),
                     most == 1 ? "has one" : "have one each");
}

// "; or exchanged with A or B, whose change is the opposite"
std::string MaybeText(const CampaignChange& change, const std::vector<CampaignString>& after) {
  std::string names;
  for (const std::int32_t other : change.maybe) {
    names += (names.empty() ? "" : " or ") + after[other].id;
  }
  return names.empty() ? "" : "; or exchanged with " + names + ", whose figures changed places";
}

struct ChangeTexts {
  std::string sentence, candidates, action;
};

ChangeTexts TextsOf(const Campaign& campaign, const std::vector<CampaignString>& before,
                    const std::vector<CampaignString>& after, std::size_t i) {
  const CampaignChange& change = campaign.changes[i];
  switch (change.kind) {
    case CampaignKind::kNotCompared:
      return {"not compared: " + change.why_not, "", ""};
    case CampaignKind::kNone:
      return {"no change beyond what is usual: " + FiguresText(change), "", ""};
    case CampaignKind::kNew:
      return {"the earlier results have no string of this name", "", ""};
    case CampaignKind::kRenamed:
      return {fmt::format("may be {} under another name: its figures agree, and that name is gone",
                          before[change.partner].id),
              "renamed new", "Compare the plan of the plant."};
    case CampaignKind::kExchanged:
      return {fmt::format("has the earlier figures of {}, and that one those of this: exchanged "
                          "names or cables; else one was repaired and the other failed alike. {}",
                          after[change.partner].id, FiguresText(change)),
              "exchanged", "Compare labels and cables of both with the plan."};
    case CampaignKind::kMeasurement:
      return {fmt::format("differs, but the light or the conditions changed during {} sweep: {}",
                          after[i].repeat ? "this" : "the earlier", FiguresText(change)),
              "", after[i].repeat ? "Repeat the sweep." : ""};
    default:
      break;
  }
  const KindWords& words = *WordsOf(change.kind);
  const bool loss = change.lost_W > 0;
  const bool cause = loss && !after[i].cause.empty() &&
                     after[i].cause != before[change.before].cause &&
                     change.kind != CampaignKind::kLight;
  ChangeTexts texts;
  texts.sentence =
      fmt::format("{}{}{}: {}", loss ? words.what : words.gained,
                  StepText(change, after[i]) + MaybeText(change, after),
                  cause ? "; the sweep itself shows " + after[i].cause : "", FiguresText(change));
  texts.candidates = cause ? after[i].cause : loss ? words.candidates : words.gained_candidates;
  if (change.steps_high == 1 && loss) texts.candidates = "bypass_short";
  if (!change.maybe.empty()) texts.candidates += " exchanged";
  texts.action = loss ? words.action : kNote;
  return texts;
}

// What a shift of all strings may come from.
std::string CommonSentence(const CampaignGroup& group, const char* whose) {
  std::string text;
  for (std::size_t q = 0; q < kCampaignFigures.size(); ++q) {
    text += fmt::format("{}{} {:+.2f} %", text.empty() ? "" : ", ", kCampaignFigures[q],
                        Percent(group.shift[q]));
  }
  return fmt::format(
      "{}: {}. Current and power: light (dirt, shade, age of all modules) or the light sensor; "
      "voltage: temperature sensor or age. Nothing in these sweeps decides between both",
      whose, text);
}

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

void SummariseCampaign(const Campaign& campaign, const std::vector<CampaignString>& before,
                       const std::vector<CampaignString>& after, CampaignSummary* summary) {
  summary->level = campaign.level;
  summary->plant = CommonChangeOf(campaign.plant);
  summary->compared = campaign.plant.strings;
  for (const CampaignGroup& group : campaign.groups) {
    if (group.differs) summary->groups.push_back(CommonChangeOf(group));
  }
  for (std::size_t i = 0; i < after.size(); ++i) {
    const CampaignChange& change = campaign.changes[i];
    const bool fresh = change.kind == CampaignKind::kNew || change.kind == CampaignKind::kRenamed;
    if (fresh) {
      ++summary->fresh;
      if (summary->fresh_ids.size() < kMostChanges) summary->fresh_ids.push_back(after[i].id);
    }
    const auto self = static_cast<std::int32_t>(i);
    if (change.kind == CampaignKind::kExchanged && self < change.partner) {
      summary->exchanged.emplace_back(after[i].id, after[change.partner].id);
    }
    if (change.rank > 0) {
      ++summary->changed;
      (change.lost_W > 0 ? summary->lost_W : summary->gained_W) += std::fabs(change.lost_W);
    }
    const bool listed = change.kind == CampaignKind::kRenamed || change.rank > 0;
    if (!listed || change.rank > static_cast<std::int32_t>(kMostChanges)) continue;
    const ChangeTexts texts = TextsOf(campaign, before, after, i);
    const auto percent = [&](int q) {
      return HasChange(change) ? Percent(change.own[q]) : kUnknown;
    };
    summary->changes.push_back({change.rank, after[i].id, ToText(change.kind), texts.sentence,
                                texts.candidates, texts.action, percent(kCIsc), percent(kCVoc),
                                percent(change.adjusted ? int{kAdjustedFill} : int{kCFillFactor}),
                                change.lost_W, change.lost_low_W, change.lost_high_W});
  }
  std::stable_sort(summary->changes.begin(), summary->changes.end(),
                   [](const StringChange& one, const StringChange& other) {
                     const auto last = [](std::int64_t rank) { return rank == 0 ? 1 : 0; };
                     return std::pair(last(one.rank), one.rank) <
                            std::pair(last(other.rank), other.rank);
                   });
  summary->gone = static_cast<std::int64_t>(campaign.gone.size());
  summary->not_repeated = campaign.not_repeated;
  for (const std::int32_t k : campaign.gone) {
    if (summary->gone_ids.size() < kMostChanges) summary->gone_ids.push_back(before[k].id);
  }
}

}  // namespace lyrefit
