#include "plant/plant_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plant/campaign_document.h"
#include "plant/plant_figures.h"
#include "plant/plant_text.h"

namespace lyrefit {
namespace {

using Shares = std::map<std::string, PlantShare>;

constexpr int kColumnsShown = 11;
constexpr const char* kFirstColumns[] = {"id",
                                         "page",
                                         "status",
                                         "zone",
                                         "string_to_do",
                                         "string_cause_title",
                                         "cause_title",
                                         "onset_date",
                                         "loss_total_percent",
                                         "loss_now_total_percent",
                                         "loss_light_percent",
                                         "loss_resistance_series_percent",
                                         "p_mp_rate_percent",
                                         "performance_factor",
                                         "Pmax_stc_W",
                                         "group_deviation_percent",
                                         "string_lost_W",
                                         "recoverable_power_W",
                                         "change_lost_W",
                                         "change_kind",
                                         "plan_cause_title",
                                         "plan_lost_W",
                                         "group_outlier",
                                         "date",
                                         "cause",
                                         "Pmax_W",
                                         "FF",
                                         "Isc_A",
                                         "Voc_V",
                                         "Rs_ohm",
                                         "n1",
                                         "irradiance_Wm2",
                                         "temperature_C",
                                         "reason"};

std::string Number(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "";
}

std::string Share(std::int64_t part, std::int64_t all) {
  return all > 0 ? fmt::format("{:.1f} %", 100.0 * part / all) : "";
}

block::Table ZonesTable(const PlantSummary& summary) {
  block::Table table = {"lrr", {{"zone", "strings", "of all"}}};
  table.caption = "Strings by zone";
  const auto add = [&](const std::string& zone, std::int64_t rows) {
    table.rows.push_back({zone, Counted(rows), Share(rows, summary.rows)});
  };
  std::map<std::string, PlantShare> others = summary.zones;
  for (const char* zone :
       {"pass", "pass within uncertainty", "undecided", "fail within uncertainty", "fail"}) {
    add(zone, others[zone].rows);
    others.erase(zone);
  }
  for (const auto& [zone, share] : others) add(zone, share.rows);
  return table;
}

void AddCauses(const std::string& caption, const Shares& causes, Section* section) {
  if (causes.empty()) return;
  block::Table table = {"lrr", {{"cause", "strings", "power to recover"}}};
  table.caption = caption;
  for (const auto& cause : Ordered(causes)) {
    const double power = cause.second.recoverable_power_W;
    table.rows.push_back({Title(cause), Counted(cause.second.rows), power > 0 ? Power(power) : ""});
  }
  AddTable(std::move(table), section);
}

// A link to the row's page. Only paths in the form of StringPagePath are linked, since files may
// hold any text.
std::string LinkOf(const PlantRow& row, const std::string& results) {
  const bool safe = row.page.rfind("pages/", 0) == 0 && row.page.find("..") == std::string::npos;
  return safe ? "./" + results + row.page : "";
}

// Leaves out the columns of which no row has anything.
block::Table WithoutEmptyColumns(block::Table table) {
  for (std::size_t c = table.alignment.size(); c-- > 0;) {
    const bool any = std::any_of(table.rows.begin(), table.rows.end(),
                                 [c](const block::Table::Row& row) { return !row[c].empty(); });
    if (any) continue;
    const auto at = static_cast<std::ptrdiff_t>(c);
    table.alignment.erase(c, 1);
    for (auto* rows : {&table.heads, &table.rows}) {
      for (block::Table::Row& row : *rows) row.erase(row.begin() + at);
    }
  }
  return table;
}

block::Table WorstTable(const PlantSummary& summary, const std::string& results) {
  block::Table table = {
      "lrrrlrllw",
      {{"string", "lost (W)", "performance factor", "Pmax at STC (W)", "zone", "power lost now (%)",
        "mostly by", "since", "what is seen, and what to do"}}};
  table.caption = fmt::format("The {} worst strings, by {}", summary.worst.size(),
                              ColumnInWords(summary.worst_by));
  for (const PlantRow& row : summary.worst) {
    const bool judged = row.verdict.NeedsAVisit();
    table.rows.push_back({row.id, Number(row.lost_W(), 0), Number(row.performance_factor, 3),
                          judged ? "" : Number(row.Pmax_stc_W, 0), row.verdict.zone,
                          Number(row.lost_now_percent, 2), row.largest_loss, row.onset_date,
                          judged ? SeenAndToDo(row.verdict) : ""});
    table.links.push_back(LinkOf(row, results));
  }
  return WithoutEmptyColumns(std::move(table));
}

block::Table OutliersTable(const PlantSummary& summary, const std::string& results) {
  block::Table table = {"lw", {{"string", "differs in"}}};
  table.caption = "Strings that differ most from those of the same combiner";
  for (const PlantRow& row : summary.outliers) {
    table.rows.push_back({row.id, row.verdict.outlier.empty()
                                      ? Number(row.deviation_percent, 2) + " %"
                                      : row.verdict.outlier});
    table.links.push_back(LinkOf(row, results));
  }
  return table;
}

Section NotJudged(const PlantSummary& summary) {
  Section section = {"Not judged"};
  if (summary.reasons.empty()) return section;
  block::Table reasons = {"wr", {{"reason", "strings"}}};
  reasons.caption = "Why there is no result";
  for (const auto& [reason, share] : Ordered(summary.reasons)) {
    reasons.rows.push_back({reason, Counted(share.rows)});
  }
  AddTable(std::move(reasons), &section);
  block::Table rows = {"lw", {{"string", "reason"}}};
  const std::int64_t all = summary.rows - summary.fine;
  const auto listed = static_cast<std::int64_t>(summary.broken.size());
  rows.caption =
      listed < all ? fmt::format("The first {} of {}", listed, Counted(all)) : "All of them";
  for (const PlantRow& row : summary.broken) rows.rows.push_back({row.id, row.reason});
  AddTable(std::move(rows), &section);
  return section;
}

// The table of all rows. It shows first what tells most.
block::LongTable AllRows(const PlantContent& content) {
  std::vector<std::string> shown;
  const auto show = [&](const std::string& name) {
    const auto there = [&](const ResultColumn& column) { return column.name == name; };
    const auto& columns = content.columns;
    const bool is = std::any_of(columns.begin(), columns.end(), there) &&
                    std::find(shown.begin(), shown.end(), name) == shown.end();
    if (is && shown.size() < std::size_t{kColumnsShown}) shown.push_back(name);
  };
  for (const char* name : kFirstColumns) show(name);
  for (const ResultColumn& column : content.columns) {
    if (column.name != "sparkline") show(column.name);
  }
  block::LongTable table;
  table.links = content.results;
  const auto place = [&shown](const std::string& name) {
    return std::find(shown.begin(), shown.end(), name) - shown.begin();
  };
  for (const ResultColumn& column : content.columns) {
    const bool number = column.type == CellType::kNumber || column.type == CellType::kWhole;
    const std::string doc =
        column.unit.empty() ? column.doc : column.doc + " (" + column.unit + ")";
    table.columns.push_back({column.name, doc, number, place(column.name) < kColumnsShown});
  }
  std::stable_sort(table.columns.begin(), table.columns.end(),
                   [&](const auto& a, const auto& b) { return place(a.name) < place(b.name); });
  return table;
}

Section AboutPage(const PlantContent& content) {
  Section section = {"About this page"};
  const PlantSummary& summary = content.summary;
  if (!summary.last_date.empty()) {
    const bool one = summary.first_date == summary.last_date;
    AddField("Measured", summary.first_date + (one ? "" : " to " + summary.last_date), &section);
  }
  for (const block::Field& fact : content.facts) AddField(fact.name, fact.text, &section);
  return section;
}

}  // namespace

Document PlantDocument(const PlantContent& content) {
  const PlantSummary& summary = content.summary;
  Document document;
  document.head.heading = content.plant;
  document.verdict = PlantVerdict(summary);
  AddFigure(GroupsFigure(summary), &document.head);
  AddFigure(MapFigure(summary), &document.head);
  Section found = {"What was found"};
  if (!summary.zones.empty()) AddTable(ZonesTable(summary), &found);
  AddCauses("Strings that need work, by cause", summary.causes, &found);
  AddCauses("Strings to measure again, by cause", summary.causes_to_repeat, &found);
  AddCauses("Strings that pass and show a cause", summary.causes_of_passed, &found);
  std::vector<Section> since = CampaignSections(content.campaign, kMostChanges);
  if (!since.empty()) {
    AddFigure(CampaignFigureOf(content.campaign), &since.front());
    document.verdict += " " + CampaignVerdict(content.campaign);
  }
  Section losses = {"Losses over time"};
  AddFigure(LossesFigure(summary.losses), &losses);
  Section worst = {"Which strings to visit first"};
  if (!summary.worst.empty()) AddTable(WorstTable(summary, content.results), &worst);
  AddFigure(CurvesFigure(summary), &worst);
  Section all = {"All strings"};
  if (summary.rows > 0) all.blocks.emplace_back(AllRows(content));
  Section spreads = {"Distributions"};
  AddFigure(SpreadsFigure(summary), &spreads);
  Section neighbours = {"Against the neighbours"};
  if (!summary.outliers.empty()) AddTable(OutliersTable(summary, content.results), &neighbours);
  AddFigure(NeighboursFigure(summary), &neighbours);
  AddSections({found, losses}, &document);
  AddSections(std::move(since), &document);
  AddSections({worst, all, spreads, neighbours, NotJudged(summary), AboutPage(content)}, &document);
  return document;
}

}  // namespace lyrefit
