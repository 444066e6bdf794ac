#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "lyrefit/base/try.h"
#include "lyrefit/batch/plant_page.h"

namespace lyrefit {
namespace {

using Json = nlohmann::ordered_json;

// Calls `see` for the object of every line. Returns the number of lines.
template <class See>
Expected<std::int64_t> EachResult(const std::string& path, const See& see) {
  std::ifstream file(path);
  if (!file) return Fail("cannot open the results", path);
  std::int64_t rows = 0;
  int line = 0;
  for (std::string text; std::getline(file, text);) {
    ++line;
    if (text.find_first_not_of(" \t\r") == std::string::npos) continue;
    const Json row = Json::parse(text, nullptr, false);
    if (!row.is_object()) return Fail("expected a JSON object, a row of results", path, line);
    TRY(see(row));
    ++rows;
  }
  return rows;
}

CellType TypeOf(const Json& value) {
  if (value.is_boolean()) return CellType::kTruth;
  if (value.is_number_integer()) return CellType::kWhole;
  return value.is_number() ? CellType::kNumber : CellType::kText;
}

CellType Common(CellType one, CellType other) {
  if (one == other) return one;
  const auto is_number = [](CellType type) {
    return type == CellType::kNumber || type == CellType::kWhole;
  };
  return is_number(one) && is_number(other) ? CellType::kNumber : CellType::kText;
}

ResultCell CellOf(const Json& value, CellType type) {
  if (value.is_null()) return {};
  switch (type) {
    case CellType::kTruth:
      return value.get<bool>();
    case CellType::kWhole:
      return value.get<std::int64_t>();
    case CellType::kNumber:
      return value.get<double>();
    case CellType::kText:
      break;
  }
  if (value.is_string()) return value.get<std::string>();
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// Determines the columns of a file from its values.
class ColumnFinder {
 public:
  explicit ColumnFinder(const std::vector<ResultColumn>& known) : known_(known) {}

  void See(const Json& row) {
    for (const auto& [name, value] : row.items()) {
      const auto place = places_.emplace(name, columns_.size());
      if (place.second) columns_.push_back(Named(name));
      if (value.is_null()) continue;
      CellType& type = columns_[place.first->second].type;
      type = seen_[name]++ == 0 ? TypeOf(value) : Common(type, TypeOf(value));
    }
  }

  const std::vector<ResultColumn>& columns() const { return columns_; }

  ResultRow RowOf(const Json& row) const {
    ResultRow cells{std::vector<ResultCell>(columns_.size())};
    for (const auto& [name, value] : row.items()) {
      const std::size_t place = places_.at(name);
      cells.cells[place] = CellOf(value, columns_[place].type);
    }
    return cells;
  }

 private:
  ResultColumn Named(const std::string& name) const {
    const auto at = std::find_if(known_.begin(), known_.end(),
                                 [&](const ResultColumn& column) { return column.name == name; });
    ResultColumn column;
    if (at != known_.end()) column = *at;
    column.name = name;
    return column;
  }

  const std::vector<ResultColumn>& known_;
  std::vector<ResultColumn> columns_;
  std::map<std::string, std::size_t> places_;
  std::map<std::string, std::int64_t> seen_;
};

}  // namespace

Expected<std::int64_t> WritePlantPage(const std::string& results_jsonl, const std::string& file,
                                      const PlantPageOptions& options,
                                      const std::vector<ResultColumn>& known) {
  ColumnFinder finder(known);
  TRY(EachResult(results_jsonl, [&](const Json& row) -> Expected<void> {
    finder.See(row);
    return {};
  }));
  std::vector<ResultColumn> columns = finder.columns();
  if (columns.empty()) columns = known;
  TRY(const std::unique_ptr<PlantPage> page, PlantPage::Open(file, columns, options));
  TRY(const std::int64_t rows,
      EachResult(results_jsonl, [&](const Json& row) { return page->Add(finder.RowOf(row)); }));
  TRY(page->Finish());
  return rows;
}

}  // namespace lyrefit
