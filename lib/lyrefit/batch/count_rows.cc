#include "lyrefit/batch/count_rows.h"

#include <algorithm>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/reasons.h"

namespace lyrefit {

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
