#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/reasons.h"
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

std::size_t ColumnPlace(const std::vector<ResultColumn>& columns, const std::string& name) {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [&name](const ResultColumn& c) { return c.name == name; });
  return found == columns.end() ? kNoColumn : static_cast<std::size_t>(found - columns.begin());
}

RowReader::RowReader(const std::vector<ResultColumn>& columns) {
  for (std::size_t k = 0; k < columns.size(); ++k) places_.try_emplace(columns[k].name, k);
}

const ResultCell* RowReader::Find(const ResultRow& row, std::string_view name) const {
  const auto found = places_.find(name);
  const bool there = found != places_.end() && found->second < row.cells.size();
  return there ? &row.cells[found->second] : nullptr;
}

std::string RowReader::Text(const ResultRow& row, std::string_view name) const {
  const auto* const text = std::get_if<std::string>(Find(row, name));
  return text == nullptr ? "" : *text;
}

double RowReader::Number(const ResultRow& row, std::string_view name) const {
  const ResultCell* const cell = Find(row, name);
  if (const auto* const number = std::get_if<double>(cell)) return *number;
  const auto* const whole = std::get_if<std::int64_t>(cell);
  return whole == nullptr ? kUnknown : static_cast<double>(*whole);
}

bool RowReader::Truth(const ResultRow& row, std::string_view name) const {
  const auto* const truth = std::get_if<bool>(Find(row, name));
  return truth != nullptr && *truth;
}

void RowCounter::Count(const ResultRow& row) {
  const auto add = [&](const char* name, std::map<std::string, std::int64_t>* counts) {
    const std::string text = reader_.Text(row, name);
    if (!text.empty()) ++(*counts)[text];
  };
  ++counts_.rows;
  add("status", &counts_.statuses);
  add("zone", &counts_.zones);
  add("cause", &counts_.causes);
  add("cause_about", &counts_.abouts);
  const std::string reason = reader_.Text(row, "reason");
  if (reason.empty()) return;
  std::string kind = WithoutNumbers(reason);
  auto& reasons = counts_.reasons;
  if (reasons.count(kind) == 0 && reasons.size() >= kMostReasons) kind = kOthers;
  ReasonCount& count = reasons[kind];
  if (count.rows++ > 0) return;
  count.first = reason;
  count.where = reader_.Text(row, "where");
}

}  // namespace lyrefit
