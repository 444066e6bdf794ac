#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/batch/result_row.h"
#include "lyrefit/report/csv.h"

namespace lyrefit {

// Rows as text. A number has the shortest digits that bring back the same bits, here and there.

// {"id":"...","status":"fine",...}: every column, in their order, null where it is not known.
std::string RowJson(const std::vector<ResultColumn>& columns, const ResultRow& row);

// The same read back; a column that is missing, or of another kind, is not known.
ResultRow RowOf(const std::vector<ResultColumn>& columns, const nlohmann::json& json);

// A line of fields, empty where not known.
std::string RowCsv(const ResultRow& row, CsvTexts texts = CsvTexts::kSafe);
std::string HeadCsv(const std::vector<ResultColumn>& columns);

// [{"name", "type", "unit", "description"}]: the fields of a Table Schema
// (specs.frictionlessdata.io/table-schema), which leaves room for the unit.
nlohmann::ordered_json FieldsJson(const std::vector<ResultColumn>& columns);
// The same read back.
Expected<std::vector<ResultColumn>> ReadColumns(const nlohmann::ordered_json& fields);

}  // namespace lyrefit
