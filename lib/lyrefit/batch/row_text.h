#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/batch/result_row.h"
#include "lyrefit/report/csv.h"

namespace lyrefit {

// Rows as text. A number is written with the fewest digits that restore the same bits.

// {"id":"...","status":"fine",...}: every column in order; null: unknown.
std::string RowJson(const std::vector<ResultColumn>& columns, const ResultRow& row);

// Reads a row from the JSON of RowJson. A missing column, or one of another type, is unknown.
ResultRow RowOf(const std::vector<ResultColumn>& columns, const nlohmann::json& json);

// A CSV line; unknown cells are empty fields.
std::string RowCsv(const ResultRow& row, CsvTexts texts = CsvTexts::kSafe);
std::string HeadCsv(const std::vector<ResultColumn>& columns);

// [{"name", "type", "unit", "description"}]: the fields of a Table Schema
// (specs.frictionlessdata.io/table-schema), which allows further keys such as the unit.
nlohmann::ordered_json FieldsJson(const std::vector<ResultColumn>& columns);
// Reads columns from the JSON of FieldsJson.
Expected<std::vector<ResultColumn>> ReadColumns(const nlohmann::ordered_json& fields);

}  // namespace lyrefit
