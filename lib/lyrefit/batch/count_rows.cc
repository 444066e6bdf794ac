#include "lyrefit/batch/count_rows.h"

#include <algorithm>

#include "lyrefit/base/reasons.h"

namespace lyrefit {
namespace {

template <class T>
const T* In(const ResultRow& row, std::size_t column) {
  return column < row.cells.size() ? std::get_if<T>(&row.cells[column]) : nullptr;
}

}  // namespace

std::size_t ColumnPlace(const std::vector<ResultColumn>& columns, const char* name) {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [name](const ResultColumn& c) { return c.name == name; });
  return static_cast<std::size_t>(found - columns.begin());
}

RowCounter::RowCounter(const std::vector<ResultColumn>& columns)
    : status_(ColumnPlace(columns, "status")),
      reason_(ColumnPlace(columns, "reason")),
      where_(ColumnPlace(columns, "where")),
      zone_(ColumnPlace(columns, "zone")),
      cause_(ColumnPlace(columns, "cause")),
      about_(ColumnPlace(columns, "cause_about")),
      flag_(ColumnPlace(columns, "group_flag")),
      plan_(ColumnPlace(columns, "plan_cause")) {}

void RowCounter::Count(const ResultRow& row) {
  ++counts_.rows;
  if (const auto* status = In<std::string>(row, status_)) ++counts_.statuses[*status];
  if (const auto* zone = In<std::string>(row, zone_)) ++counts_.zones[*zone];
  if (const auto* cause = In<std::string>(row, cause_)) ++counts_.causes[*cause];
  if (const auto* plan = In<std::string>(row, plan_)) ++counts_.plan_causes[*plan];
  if (const auto* about = In<std::string>(row, about_)) ++counts_.abouts[*about];
  if (const bool* flag = In<bool>(row, flag_)) {
    ++counts_.compared;
    counts_.flagged += *flag ? 1 : 0;
  }
  const auto* const reason = In<std::string>(row, reason_);
  if (reason == nullptr) return;
  std::string kind = WithoutNumbers(*reason);
  auto& reasons = counts_.reasons;
  if (reasons.count(kind) == 0 && reasons.size() >= kMostReasons) kind = kOthers;
  ReasonCount& count = reasons[kind];
  const auto* const where = In<std::string>(row, where_);
  if (count.rows++ > 0) return;
  count.first = *reason;
  if (where != nullptr) count.where = *where;
}

}  // namespace lyrefit
