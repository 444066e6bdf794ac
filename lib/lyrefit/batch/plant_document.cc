#include "lyrefit/batch/plant_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/batch/plant_picture.h"
#include "lyrefit/curve/number_text.h"
#include "lyrefit/report/html_parts.h"
#include "lyrefit/report/text_layout.h"

namespace lyrefit {
namespace {

using Shares = std::map<std::string, PlantShare>;

std::string Number(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "";
}

std::string Power(double watts) {
  if (watts >= 999500) return Significant(watts / 1e6, 3) + " MW";
  if (watts >= 9999.5) return Significant(watts / 1000, 3) + " kW";
  return watts >= 999.5 ? Significant(watts / 1000, 2) + " kW" : fmt::format("{:.0f} W", watts);
}

std::string Share(std::int64_t part, std::int64_t all) {
  return all > 0 ? fmt::format("{:.1f} %", 100.0 * part / all) : "";
}

// 1234567 as 1,234,567.
std::string Counted(std::int64_t count) {
  std::string text = std::to_string(count);
  for (std::size_t place = text.size(); place > 3;) text.insert(place -= 3, ",");
  return text;
}

// By decreasing count.
std::vector<std::pair<std::string, PlantShare>> Ordered(const Shares& shares) {
  std::vector<std::pair<std::string, PlantShare>> ordered(shares.begin(), shares.end());
  std::stable_sort(ordered.begin(), ordered.end(), [](const auto& one, const auto& other) {
    return one.second.rows > other.second.rows;
  });
  return ordered;
}

std::string Title(const std::pair<std::string, PlantShare>& cause) {
  return cause.second.title.empty() ? cause.first : cause.second.title;
}

std::string Listed(const Shares& shares, std::size_t most) {
  std::string text;
  const auto ordered = Ordered(shares);
  std::int64_t rest = 0;
  for (std::size_t c = 0; c < ordered.size(); ++c) {
    if (c >= most) {
      rest += ordered[c].second.rows;
      continue;
    }
    text += fmt::format("{}{} ({})", c == 0 ? "" : ", ", LowerCase(Title(ordered[c])),
                        Counted(ordered[c].second.rows));
  }
  return rest > 0 ? text + fmt::format(", others ({})", Counted(rest)) : text;
}

struct Row {
  std::vector<std::string> cells;  // escaped HTML
  // The filter that a script sets when the row's name is pressed: column and value.
  std::string column = {};
  std::string value = {};
};

std::string RowStart(const Row& row) {
  if (row.column.empty()) return "<tr>";
  return fmt::format("<tr data-column=\"{}\" data-value=\"{}\">", row.column,
                     HtmlEscaped(row.value));
}

// The first cell of a row is its header. Columns with alignment 'r' are numbers.
std::string Table(const std::string& caption, const std::string& alignment,
                  const std::vector<std::string>& head, const std::vector<Row>& rows) {
  std::string html = fmt::format(
      "<div class=\"box\" role=\"region\" tabindex=\"0\" aria-label=\"{0}\"><table>\n"
      "<caption>{0}</caption>\n<thead><tr>",
      HtmlEscaped(caption));
  for (std::size_t c = 0; c < head.size(); ++c) {
    html += fmt::format("<th scope=\"col\"{}>{}</th>",
                        alignment[c] == 'r' ? " class=\"number\"" : "", HtmlEscaped(head[c]));
  }
  html += "</tr></thead>\n<tbody>\n";
  for (const Row& row : rows) {
    html += RowStart(row);
    for (std::size_t c = 0; c < row.cells.size(); ++c) {
      const char* tag = c == 0 ? "th" : "td";
      html += fmt::format("<{0}{1}{2}>{3}</{0}>", tag, c == 0 ? " scope=\"row\"" : "",
                          alignment[c] == 'r' ? " class=\"number\"" : "", row.cells[c]);
    }
    html += "</tr>\n";
  }
  return html + "</tbody>\n</table></div>\n";
}

std::string PlantPart(const std::string& id, const std::string& heading, const std::string& html) {
  if (html.empty()) return "";
  return fmt::format("<section id=\"{0}\" aria-labelledby=\"{0}-h\">\n<h2 id=\"{0}-h\">{1}</h2>\n",
                     id, heading) +
         html + "</section>\n";
}

std::string ZonesTable(const PlantSummary& summary) {
  if (summary.zones.empty()) return "";
  std::vector<Row> rows;
  for (const char* zone : {"pass", "pass within uncertainty", "fail within uncertainty", "fail"}) {
    const auto at = summary.zones.find(zone);
    const std::int64_t count = at == summary.zones.end() ? 0 : at->second.rows;
    rows.push_back(
        {{ZoneMark(zone) + zone, Counted(count), Share(count, summary.rows)}, "zone", zone});
  }
  for (const auto& [zone, share] : summary.zones) {
    if (ZoneMark(zone).empty()) {
      rows.push_back({{HtmlEscaped(zone), Counted(share.rows), Share(share.rows, summary.rows)},
                      "zone",
                      zone});
    }
  }
  return "<div>" + Table("Strings by zone", "lrr", {"Zone", "Strings", "of all"}, rows) + "</div>";
}

std::string CausesTable(const std::string& caption, const Shares& causes) {
  std::vector<Row> rows;
  for (const auto& cause : Ordered(causes)) {
    const double power = cause.second.recoverable_power_W;
    rows.push_back(
        {{HtmlEscaped(Title(cause)), Counted(cause.second.rows), power > 0 ? Power(power) : ""},
         cause.first == kNoCause ? "" : "cause",
         cause.first});
  }
  if (rows.empty()) return "";
  return "<div>" + Table(caption, "lrr", {"Cause", "Strings", "Power to recover"}, rows) + "</div>";
}

// The row's name, with a link to its page if it has one. Only paths in the form of StringPagePath
// are linked, since files may hold any text.
std::string Linked(const PlantRow& row, const std::string& results) {
  const bool safe = row.page.rfind("pages/", 0) == 0 && row.page.find("..") == std::string::npos;
  if (!safe) return HtmlEscaped(row.id);
  return "<a href=\"./" + HtmlEscaped(results + row.page) + "\">" + HtmlEscaped(row.id) + "</a>";
}

std::string WorstTable(const PlantSummary& summary, const std::string& results) {
  if (summary.worst.empty()) return "";
  std::vector<Row> rows;
  for (const PlantRow& row : summary.worst) {
    const std::string& cause = row.cause_title.empty() ? row.cause : row.cause_title;
    rows.push_back({{Linked(row, results), Number(row.performance_factor, 3),
                     Number(row.Pmax_stc_W, 0), ZoneMark(row.zone) + HtmlEscaped(row.zone),
                     HtmlEscaped(cause), Number(row.recoverable_power_W, 0)}});
  }
  return Table(
      fmt::format("The {} worst strings, by {}", rows.size(), summary.worst_by), "lrrllr",
      {"String", "Performance factor", "Pmax at STC (W)", "Zone", "Cause", "Power to recover (W)"},
      rows);
}

std::string BrokenTables(const PlantSummary& summary) {
  if (summary.reasons.empty()) return "";
  std::vector<Row> reasons;
  for (const auto& [reason, share] : Ordered(summary.reasons)) {
    reasons.push_back({{HtmlEscaped(reason), Counted(share.rows)}});
  }
  std::vector<Row> rows;
  for (const PlantRow& row : summary.broken) {
    rows.push_back({{HtmlEscaped(row.id), HtmlEscaped(row.reason)}});
  }
  const std::string first =
      static_cast<std::int64_t>(rows.size()) < summary.rows - summary.fine
          ? fmt::format("The first {} of {}", rows.size(), Counted(summary.rows - summary.fine))
          : "All of them";
  return Table("Why there is no result", "lr", {"Reason", "Strings"}, reasons) +
         Table(first, "ll", {"String", "Reason"}, rows);
}

std::string Facts(const PlantSummary& summary, const PlantPageOptions& options) {
  std::vector<PlantFact> facts = options.facts;
  std::string html = "<dl>";
  if (!summary.last_date.empty()) {
    html +=
        "<dt>Measured</dt><dd>" + HtmlEscaped(summary.first_date) +
        (summary.first_date == summary.last_date ? "" : " to " + HtmlEscaped(summary.last_date)) +
        "</dd>\n";
  }
  for (const PlantFact& fact : facts) {
    html += HtmlElement("dt", fact.name) + HtmlElement("dd", fact.text) + "\n";
  }
  return html + "</dl>\n";
}

std::string Plural(std::int64_t count, const std::string& what) {
  return fmt::format("{} {}{}", Counted(count), what, count == 1 ? "" : "s");
}

}  // namespace

std::string PlantVerdict(const PlantSummary& summary) {
  if (summary.rows == 0) return "No strings.";
  const std::string all = Plural(summary.rows, "string");
  const char* verb = summary.rows == 1 ? "s" : "";
  if (summary.judged_by.empty()) {
    return fmt::format("{} of {} ha{} a result.", Counted(summary.fine), all,
                       summary.rows == 1 ? "s" : "ve");
  }
  std::string text =
      summary.judged_by == "zone"
          ? fmt::format("{} of {} pass{}", Counted(summary.passed), all, *verb ? "es" : "")
          : fmt::format("{} of {} show{} no cause",
                        Counted(summary.fine - summary.in_need - summary.to_repeat), all, verb);
  if (summary.in_need > 0) {
    text += fmt::format("; {} need{} work: {}", Counted(summary.in_need),
                        summary.in_need == 1 ? "s" : "", Listed(summary.causes, 6));
  }
  if (summary.in_need > 0 && summary.recoverable_power_W > 0) {
    text += ", worth about " + Power(summary.recoverable_power_W);
  }
  if (summary.in_need > 0 && summary.below_rating_W > 0) {
    text += fmt::format(". They are {} below their rating at standard conditions",
                        Power(summary.below_rating_W));
  }
  text += ".";
  if (summary.to_repeat > 0) {
    text += fmt::format(" {} {} to be measured again, for a cause of the measurement alone: {}.",
                        Counted(summary.to_repeat), summary.to_repeat == 1 ? "has" : "have",
                        Listed(summary.causes_to_repeat, 6));
  }
  std::int64_t beside = 0;
  for (const auto& [cause, share] : summary.causes_of_passed) beside += share.rows;
  if (beside > 0) {
    text += fmt::format(" Of those that pass, {} show{} a cause all the same: {}.", Counted(beside),
                        beside == 1 ? "s" : "", Listed(summary.causes_of_passed, 6));
  }
  if (summary.passed_outlier > 0) {
    text += fmt::format(" {} that need{} no work by this differ{} from the strings of {} combiner.",
                        Counted(summary.passed_outlier), summary.passed_outlier == 1 ? "s" : "",
                        summary.passed_outlier == 1 ? "s" : "",
                        summary.passed_outlier == 1 ? "its" : "their");
  }
  if (summary.fine < summary.rows) {
    text += fmt::format(" {} could not be judged.", Counted(summary.rows - summary.fine));
  }
  return text;
}

std::string PlantHead(const PlantSummary& summary) {
  return "<div class=\"verdict\">" + HtmlElement("p", PlantVerdict(summary)) +
         "</div>\n<nav class=\"contents\" aria-label=\"Sections\"><ul>"
         "<li><a href=\"#map\">Plant</a></li><li><a href=\"#strings\">All strings</a></li>"
         "<li><a href=\"#worst\">Worst</a></li><li><a href=\"#spread\">Distributions</a></li>"
         "<li><a href=\"#cloud\">One over another</a></li><li><a href=\"#trend\">Over time</a></li>"
         "<li><a href=\"#about\">About</a></li></ul></nav>\n";
}

std::string PlantBody(const PlantSummary& summary, const PlantPageOptions& options) {
  const std::string tables =
      ZonesTable(summary) + CausesTable("Causes of those that need work", summary.causes) +
      CausesTable("Causes of the measurement alone: to be taken again", summary.causes_to_repeat) +
      CausesTable("Causes of those that pass", summary.causes_of_passed);
  std::string html =
      "<noscript><p>The table of all strings and what can be chosen need scripts, which do not run "
      "here.</p></noscript>\n";
  html += "<p id=\"live-state\" role=\"status\"></p>\n<div id=\"live-filter\"></div>\n";
  html += PlantPart("summary", "What was found",
                    tables.empty() ? "" : "<div class=\"columns\">" + tables + "</div>\n");
  html += PlantPart(
      "map", "The plant",
      "<div id=\"live-map\"></div>\n<div id=\"still-map\">" + MapPicture(summary) + "</div>\n");
  html += PlantPart("strings", "All strings", "<div id=\"live-table\"></div>\n");
  html += PlantPart("worst", "Worst strings",
                    "<div id=\"live-worst\"></div>\n<div id=\"still-worst\">" +
                        WorstTable(summary, options.results) + "</div>\n");
  html += PlantPart("spread", "Distributions",
                    "<div id=\"live-spread\"></div>\n<div id=\"still-spread\">" +
                        PerformancePicture(summary) + "</div>\n");
  html += PlantPart("cloud", "One quantity over another", "<div id=\"live-cloud\"></div>\n");
  html += PlantPart("trend", "Over time", "<div id=\"live-trend\"></div>\n");
  html += PlantPart("broken", "Not judged", BrokenTables(summary));
  html += PlantPart("about", "About this page", Facts(summary, options));
  return html;
}

}  // namespace lyrefit
