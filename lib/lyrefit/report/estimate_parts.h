#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/estimate/fit/estimate_report.h"
#include "lyrefit/report/document.h"
#include "lyrefit/report/json_parts.h"

// Parts of documents and JSON that every estimate has, of whatever measurement.
namespace lyrefit {

// A column of a table of estimates. `alignment` as in block::Table.
struct EstimateColumn {
  std::string head;
  char alignment = 'r';
  std::function<std::string(const Estimate&)> cell;
};

EstimateColumn SearchedColumn();
// The refined value with so many digits.
EstimateColumn RefinedColumn(int digits = 6);
EstimateColumn ErrorColumn();
EstimateColumn IntervalColumn();

// A row for each estimate: its label, these columns, its marks.
block::Table EstimateTable(const std::vector<Estimate>& estimates,
                           const std::vector<EstimateColumn>& columns);

// How the estimate was found: search, polish, starts, intervals, the further fields, options.
Section CourseSection(const EstimateReport& report,
                      const std::vector<std::pair<std::string, std::string>>& further = {});

// JSON of correlations, search, polish and intervals.
Json CourseJson(const EstimateReport& report);

}  // namespace lyrefit
