#include "plant/campaign_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "plant/plant_text.h"

namespace lyrefit {
namespace {

constexpr std::size_t kFigureStrings = 40;
constexpr std::size_t kRanksOfAction = 8;

std::string Watts(double watts) { return std::isfinite(watts) ? fmt::format("{:.0f}", watts) : ""; }

std::string PercentText(const PercentChange& change) {
  if (!std::isfinite(change.value)) return "";
  return fmt::format("{:+.2f} [{:+.1f}, {:+.1f}]", change.value, change.low, change.high);
}

std::string Names(const std::vector<std::string>& ids, std::int64_t count, std::size_t most) {
  std::string text;
  const std::size_t shown = std::min(ids.size(), most);
  for (std::size_t k = 0; k < shown; ++k) text += (k == 0 ? "" : ", ") + ids[k];
  const std::int64_t rest = count - static_cast<std::int64_t>(shown);
  return rest > 0 ? text + fmt::format(" and {} more", Counted(rest)) : text;
}

std::string Dates(const CampaignSummary& summary) {
  if (summary.before_last_date.empty()) return "";
  if (summary.before_first_date == summary.before_last_date) return summary.before_last_date;
  return summary.before_first_date + " to " + summary.before_last_date;
}

block::Table CommonTable(const CampaignSummary& summary, std::size_t most) {
  block::Table table = {"lrrrrr",
                        {{"in common", "strings", "Isc, %", "Voc, %", "FF, %", "Pmax, %"}}};
  table.caption =
      "What all strings have in common, with the reported uncertainty. Groups that differ from the "
      "plant have a row of their own";
  const auto add = [&table](const std::string& name, const CommonChange& common) {
    block::Table::Row row = {name, Counted(common.strings)};
    for (const PercentChange& change : common.percent) row.push_back(PercentText(change));
    table.rows.push_back(std::move(row));
  };
  add("the plant", summary.plant);
  for (std::size_t g = 0; g < std::min(summary.groups.size(), most); ++g) {
    add(summary.groups[g].name, summary.groups[g]);
  }
  return table;
}

block::Table ChangesTable(const CampaignSummary& summary, std::size_t most) {
  block::Table table = {"rlrrrrl",
                        {{"rank", "string", "W lost", "Isc, %", "Voc, %", "FF, %", "change"}}};
  const std::size_t shown = std::min(summary.changes.size(), most);
  table.caption = shown < summary.changes.size()
                      ? fmt::format("The first {} of {} strings that changed, by watts lost", shown,
                                    Counted(summary.changed))
                      : "Strings that changed, by watts lost with 95 % intervals";
  const auto percent = [](double value) {
    return std::isfinite(value) ? fmt::format("{:+.1f}", value) : "";
  };
  for (std::size_t k = 0; k < shown; ++k) {
    const StringChange& change = summary.changes[k];
    const Sized& lost = change.cause.recoverable_power_W;
    table.rows.push_back({change.rank > 0 ? std::to_string(change.rank) : "", change.id,
                          std::isfinite(lost.value)
                              ? fmt::format("{} [{}, {}]", Watts(lost.value), Watts(lost.low_95),
                                            Watts(lost.high_95))
                              : "",
                          percent(change.isc_percent), percent(change.voc_percent),
                          percent(change.ff_percent), change.cause.id});
  }
  return table;
}

// "soiling, shading or sensor_offset".
std::string AnyOf(const std::vector<std::string>& ids) {
  std::string text;
  for (std::size_t k = 0; k < ids.size(); ++k) {
    text += (k == 0 ? "" : k + 1 == ids.size() ? " or " : ", ") + ids[k];
  }
  return text;
}

// What it may be and what to do, once for all strings that it is said of.
block::Table ActionsTable(const CampaignSummary& summary) {
  std::vector<std::pair<std::string, std::vector<std::string>>> actions;
  for (const StringChange& change : summary.changes) {
    if (change.cause.action.empty()) continue;
    const std::string ids = AnyOf(change.cause.equivalents);
    const std::string what = (ids.empty() ? "" : ids + ". ") + change.cause.action;
    const auto same = std::find_if(actions.begin(), actions.end(),
                                   [&](const auto& one) { return one.first == what; });
    const auto place = static_cast<std::size_t>(same - actions.begin());
    if (same == actions.end()) actions.push_back({what, {}});
    actions[place].second.push_back(change.rank > 0 ? std::to_string(change.rank) : change.id);
  }
  block::Table table = {"lw", {{"ranks", "may be, and what to do"}}};
  for (const auto& [what, ranks] : actions) {
    table.rows.push_back(
        {Names(ranks, static_cast<std::int64_t>(ranks.size()), kRanksOfAction), what});
  }
  return table;
}

}  // namespace

std::string CampaignVerdict(const CampaignSummary& summary) {
  std::string text =
      fmt::format("{} of {} strings changed since the last campaign by more than is usual",
                  summary.changed, Counted(summary.compared));
  if (summary.changed > 0) {
    text += fmt::format(": {} lost, {} gained", Power(summary.lost_W), Power(summary.gained_W));
  }
  text += ".";
  if (!summary.exchanged.empty()) {
    text += fmt::format(" {} {} of strings {} exchanged.", summary.exchanged.size(),
                        summary.exchanged.size() == 1 ? "pair" : "pairs",
                        summary.exchanged.size() == 1 ? "is" : "are");
  }
  if (summary.gone + summary.fresh > 0) {
    text += fmt::format(" Strings that are gone: {}. New strings: {}.", Counted(summary.gone),
                        Counted(summary.fresh));
  }
  return text;
}

std::vector<Section> CampaignSections(const CampaignSummary& summary, std::size_t most) {
  if (summary.before_version.empty()) return {};
  Section section = {"Since the last campaign"};
  AddSentence(CampaignVerdict(summary), &section);
  AddField("before",
           fmt::format("{} strings{}{}", Counted(summary.before_rows),
                       Dates(summary).empty() ? "" : ", ", Dates(summary)),
           &section);
  AddField("level",
           fmt::format("{:g}: the probability that any string without a change is called changed",
                       summary.level),
           &section);
  if (!summary.exchanged.empty()) {
    std::string pairs;
    for (std::size_t k = 0; k < std::min(summary.exchanged.size(), most); ++k) {
      pairs += fmt::format("{}{} and {}", k == 0 ? "" : "; ", summary.exchanged[k].first,
                           summary.exchanged[k].second);
    }
    AddField("exchanged", pairs, &section);
  }
  if (summary.gone > 0) {
    AddField("gone", Names(summary.gone_ids, summary.gone, most), &section);
  }
  if (summary.fresh > 0) {
    AddField("new", Names(summary.fresh_ids, summary.fresh, most), &section);
  }
  if (summary.not_repeated > 0) {
    AddField("not repeated",
             fmt::format("{} strings of groups that were not measured this time",
                         Counted(summary.not_repeated)),
             &section);
  }
  if (summary.compared > 0) {
    AddTable(CommonTable(summary, most), &section);
    AddSentence(summary.plant.sentence + ".", &section);
  }
  if (!summary.changes.empty()) {
    AddTable(ChangesTable(summary, most), &section);
    block::Table actions = ActionsTable(summary);
    if (!actions.rows.empty()) AddTable(std::move(actions), &section);
  }
  for (const std::string& remark : summary.remarks) AddSentence(remark, &section);
  return {std::move(section)};
}

block::Figure CampaignFigureOf(const CampaignSummary& summary) {
  block::Figure shown;
  Panel panel;
  panel.x.label = "Rank in the table of changed strings";
  panel.y.label = "Power lost (W)";
  panel.zero_line = true;
  panel.height = 320;
  Series bars, intervals;
  bars.kind = SeriesKind::kBars;
  bars.look.colour = kVermilion;
  bars.width = 0.7;
  bars.filter_columns = {"id"};
  intervals.look.colour = "#000000";
  shown.readings = {"lrrr", {{"string", "W lost", "low", "high"}}};
  for (const StringChange& change : summary.changes) {
    const Sized& lost = change.cause.recoverable_power_W;
    if (!std::isfinite(lost.value) || bars.rows.size() == kFigureStrings) continue;
    const auto x = static_cast<double>(bars.rows.size());
    bars.Add(x, lost.value);
    bars.texts.push_back(
        fmt::format("{}: {} W lost, {}", change.id, Watts(lost.value), change.cause.id));
    bars.filters.push_back({"=" + change.id});
    intervals.Add(x, lost.low_95);
    intervals.Add(x, lost.high_95);
    intervals.EndLine();
    panel.x.ticks.push_back({std::to_string(change.rank), x});
    shown.readings.rows.push_back(
        {change.id, Watts(lost.value), Watts(lost.low_95), Watts(lost.high_95)});
  }
  if (bars.rows.empty()) return shown;
  panel.x.low = -0.6;
  panel.x.high = static_cast<double>(bars.rows.size()) - 0.4;
  panel.series = {std::move(bars), std::move(intervals)};
  shown.figure.title = "Power lost since the last campaign";
  shown.caption =
      "Power at standard conditions that each string lost, less what its group has in common, with "
      "95 % intervals. A string below zero gained power.";
  shown.figure.legend = {{"power lost", {kVermilion}, LegendMark::kBar},
                         {"95 % interval", {"#000000"}, LegendMark::kLine}};
  shown.figure.panels.push_back(std::move(panel));
  return shown;
}

}  // namespace lyrefit
