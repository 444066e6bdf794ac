#include "lyrefit/batch/count_rows.h"

#include <algorithm>

#include "lyrefit/base/reasons.h"

namespace lyrefit {

std::size_t ColumnPlace(const std::vector<ResultColumn>& columns, const std::string& name) {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [&name](const ResultColumn& c) { return c.name == name; });
  return found == columns.end() ? kNoColumn : static_cast<std::size_t>(found - columns.begin());
}

RowCounter::RowCounter(const std::vector<ResultColumn>& columns)
    : status_(ColumnPlace(columns, "status")),
      reason_(ColumnPlace(columns, "reason")),
      where_(ColumnPlace(columns, "where")),
      zone_(ColumnPlace(columns, "zone")),
      cause_(ColumnPlace(columns, "cause")),
      about_(ColumnPlace(columns, "cause_about")) {}

void RowCounter::Count(const ResultRow& row) {
  ++counts_.rows;
  if (const auto* status = CellAt<std::string>(row, status_)) ++counts_.statuses[*status];
  if (const auto* zone = CellAt<std::string>(row, zone_)) ++counts_.zones[*zone];
  if (const auto* cause = CellAt<std::string>(row, cause_)) ++counts_.causes[*cause];
  if (const auto* about = CellAt<std::string>(row, about_)) ++counts_.abouts[*about];
  const auto* const reason = CellAt<std::string>(row, reason_);
  if (reason == nullptr) return;
  std::string kind = WithoutNumbers(*reason);
  auto& reasons = counts_.reasons;
  if (reasons.count(kind) == 0 && reasons.size() >= kMostReasons) kind = kOthers;
  ReasonCount& count = reasons[kind];
  const auto* const where = CellAt<std::string>(row, where_);
  if (count.rows++ > 0) return;
  count.first = *reason;
  if (where != nullptr) count.where = *where;
}

}  // namespace lyrefit
