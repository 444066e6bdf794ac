#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "lyrefit/batch/batch.h"
#include "lyrefit/batch/count_rows.h"

namespace lyrefit {
namespace {

std::string ShareOfRows(std::int64_t rows, std::int64_t all) {
  return all == 0 ? "" : fmt::format("{:.1f} %", 100.0 * static_cast<double>(rows) / all);
}

std::string Done(const BatchSummary& summary) {
  if (summary.was_complete) return "all rows were there before";
  const std::int64_t now = summary.rows - summary.rows_before;
  std::string text = fmt::format("{} in {:.1f} s", now, summary.seconds);
  if (summary.seconds > 0) {
    text += fmt::format(", {:.0f} a second", static_cast<double>(now) / summary.seconds);
  }
  if (summary.rows_before > 0) text += fmt::format("; {} were there before", summary.rows_before);
  return text;
}

// By decreasing count.
template <class Count>
std::vector<std::pair<std::string, Count>> Ordered(const std::map<std::string, Count>& counts,
                                                   std::int64_t (*rows)(const Count&)) {
  std::vector<std::pair<std::string, Count>> ordered(counts.begin(), counts.end());
  std::stable_sort(ordered.begin(), ordered.end(), [rows](const auto& a, const auto& b) {
    return rows(a.second) > rows(b.second);
  });
  return ordered;
}

std::int64_t Itself(const std::int64_t& rows) { return rows; }
std::int64_t RowsOf(const ReasonCount& count) { return count.rows; }

Section Reasons(const BatchSummary& summary) {
  Section section = {"Why rows are not fine"};
  block::Table table = {"rlw", {{"rows", "first", "reason"}}};
  for (const auto& [reason, count] : Ordered(summary.reasons, RowsOf)) {
    table.rows.push_back(
        {std::to_string(count.rows), count.where, reason == kOthers ? reason : count.first});
  }
  if (!table.rows.empty()) AddTable(std::move(table), &section);
  return section;
}

}  // namespace

Section CountsSection(const std::string& heading, const std::string& what,
                      const std::map<std::string, std::int64_t>& counts, std::int64_t all) {
  Section section = {heading};
  block::Table table = {"lrr", {{what, "rows", "share"}}};
  for (const auto& [name, rows] : Ordered(counts, Itself)) {
    table.rows.push_back({name, std::to_string(rows), ShareOfRows(rows, all)});
  }
  if (!table.rows.empty()) AddTable(std::move(table), &section);
  return section;
}

Document BatchDocument(const BatchSummary& summary) {
  Document document;
  document.head = {fmt::format("lyrefit {}: {} of many curves", summary.version, summary.task)};
  if (summary.interrupted) {
    document.banners.push_back(
        fmt::format("INTERRUPTED after {} rows: the same command with --resume goes on from there.",
                    summary.rows));
  }
  AddField("rows", std::to_string(summary.rows), &document.head);
  AddField("done", Done(summary), &document.head);
  AddField("folder", summary.folder, &document.head);
  AddField("seed", std::to_string(summary.seed), &document.head);
  for (const block::Field& field : summary.added.fields) {
    AddField(field.name, field.text, &document.head);
  }
  AddSections(summary.added.sections, &document);
  AddSections({CountsSection("Status", "status", summary.statuses, summary.rows),
               CountsSection("Against the rating", "zone", summary.zones, summary.rows),
               CountsSection("Causes", "cause", summary.causes, summary.rows)},
              &document);
  AddSections(summary.added.causes, &document);
  AddSections({CountsSection("What the causes belong to", "about", summary.abouts, summary.rows),
               Reasons(summary)},
              &document);
  return document;
}

std::string BatchText(const BatchSummary& summary) { return DrawText(BatchDocument(summary)); }

}  // namespace lyrefit
