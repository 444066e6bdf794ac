#include "lyrefit/batch/row_text.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <utility>

#include "lyrefit/base/enum_text.h"

namespace lyrefit {

// Names of the types in Table Schema.
template <>
struct EnumTable<CellType> {
  static constexpr EnumText<CellType> kRows[] = {{CellType::kText, "string"},
                                                 {CellType::kNumber, "number"},
                                                 {CellType::kWhole, "integer"},
                                                 {CellType::kTruth, "boolean"}};
};

namespace {

// Names may hold bytes that are not UTF-8.
std::string Quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

struct FieldJson {
  std::string operator()(std::monostate) const { return "null"; }
  std::string operator()(const std::string& text) const { return Quoted(text); }
  std::string operator()(double value) const {
    return std::isfinite(value) ? fmt::format("{}", value) : "null";
  }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
};

struct FieldCsv {
  CsvTexts texts;
  std::string operator()(std::monostate) const { return ""; }
  std::string operator()(const std::string& text) const { return CsvField(text, texts); }
  std::string operator()(double value) const { return CsvField(value); }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
};

ResultCell CellOf(CellType type, const nlohmann::json& json) {
  switch (type) {
    case CellType::kText:
      if (json.is_string()) return json.get<std::string>();
      break;
    case CellType::kNumber:
      if (json.is_number()) return json.get<double>();
      break;
    case CellType::kWhole:
      if (json.is_number_integer()) return json.get<std::int64_t>();
      break;
    case CellType::kTruth:
      if (json.is_boolean()) return json.get<bool>();
      break;
  }
  return {};
}

}  // namespace

std::string RowJson(const std::vector<ResultColumn>& columns, const ResultRow& row) {
  std::string text = "{";
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (k > 0) text += ',';
    text += '"' + columns[k].name + "\":" + std::visit(FieldJson(), row.cells[k]);
  }
  return text + "}";
}

ResultRow RowOf(const std::vector<ResultColumn>& columns, const nlohmann::json& json) {
  ResultRow row;
  row.cells.reserve(columns.size());
  for (const ResultColumn& column : columns) {
    const auto found = json.find(column.name);
    row.cells.push_back(found == json.end() ? ResultCell() : CellOf(column.type, *found));
  }
  return row;
}

std::string RowCsv(const ResultRow& row, CsvTexts texts) {
  std::string line;
  for (const ResultCell& cell : row.cells) line += std::visit(FieldCsv{texts}, cell) + ',';
  line.back() = '\n';
  return line;
}

std::string HeadCsv(const std::vector<ResultColumn>& columns) {
  std::vector<std::string> names;
  names.reserve(columns.size());
  for (const ResultColumn& column : columns) names.push_back(CsvField(column.name));
  return CsvLine(names);
}

nlohmann::ordered_json FieldsJson(const std::vector<ResultColumn>& columns) {
  nlohmann::ordered_json fields = nlohmann::ordered_json::array();
  for (const ResultColumn& column : columns) {
    nlohmann::ordered_json field = {{"name", column.name}, {"type", ToText(column.type)}};
    if (!column.unit.empty()) field["unit"] = column.unit;
    field["description"] = column.doc;
    fields.push_back(std::move(field));
  }
  return fields;
}

Expected<std::vector<ResultColumn>> ReadColumns(const nlohmann::ordered_json& fields) {
  std::vector<ResultColumn> columns;
  if (!fields.is_array()) return Fail("expected a list of columns");
  for (const auto& field : fields) {
    const auto text = [&field](const char* key) {
      const bool there = field.is_object() && field.contains(key) && field[key].is_string();
      return there ? field[key].get<std::string>() : std::string();
    };
    const std::optional<CellType> type = FromText<CellType>(text("type"));
    if (text("name").empty() || !type) return Fail("expected a column with a name and a type");
    columns.push_back({text("name"), text("unit"), *type, text("description")});
  }
  return columns;
}

}  // namespace lyrefit
