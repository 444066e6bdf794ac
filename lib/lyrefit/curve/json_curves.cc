#include "lyrefit/curve/json_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "lyrefit/base/try.h"
#include "lyrefit/curve/current_sign.h"
#include "lyrefit/curve/json_text.h"
#include "lyrefit/curve/number_text.h"
#include "lyrefit/curve/table_columns.h"
#include "lyrefit/curve/table_head.h"

namespace lyrefit {
namespace {

// The id of the element `key` inside the element `id`.
std::string Below(const std::string& id, const std::string& key) {
  return id.empty() ? key : fmt::format("{}.{}", id, key);
}

using nlohmann::json;

// A table in any JSON form: column names and cells.
struct JsonTable {
  std::vector<std::string> names;
  std::vector<std::vector<const json*>> columns;
};

bool IsScalar(const json& value) {
  return value.is_number() || value.is_null() || value.is_string();
}

// Adds the units of NOMAD's schema to names that state none.
std::string LabelInNomad(const std::string& key) {
  if (key == "active_area") return key + " [cm2]";
  if (key == "light_intensity" || key == "intensity") return key + " [mW/cm2]";
  return key;
}

// Lists under names, {"v": [...], "i": [...]}. Lists may also be {"0": ..., "1": ...}, as pandas
// writes columns.
JsonTable FromLists(const json& object) {
  JsonTable table;
  for (const auto& [key, value] : object.items()) {
    const bool list = (value.is_array() || value.is_object()) && value.size() >= 2 &&
                      std::all_of(value.begin(), value.end(), IsScalar);
    if (!list) continue;
    table.names.push_back(key);
    table.columns.emplace_back();
    for (const json& item : value) table.columns.back().push_back(&item);
  }
  return table;
}

// Records, [{"v": 0, "i": 1}, ...], or {"0": {"v": 0, "i": 1}, ...}, as pandas writes rows.
JsonTable FromRecords(const json& records) {
  JsonTable table;
  if (records.size() < 2 || !records.begin()->is_object()) return table;
  for (const auto& [key, value] : records.begin()->items()) {
    if (!IsScalar(value)) continue;
    table.names.push_back(key);
    table.columns.emplace_back();
  }
  static const json kNothing;
  for (const json& record : records) {
    if (!record.is_object()) return {};
    for (std::size_t i = 0; i < table.names.size(); ++i) {
      const auto found = record.find(table.names[i]);
      table.columns[i].push_back(found == record.end() ? &kNothing : &*found);
    }
  }
  return table;
}

// Split tables of pandas, {"columns": ["v", "i"], "data": [[0, 1], ...]}.
JsonTable FromSplit(const json& object) {
  JsonTable table;
  const auto names = object.find("columns");
  const auto data = object.find("data");
  if (names == object.end() || data == object.end()) return table;
  if (!names->is_array() || !data->is_array()) return table;
  for (const json& name : *names) {
    if (!name.is_string()) return {};
    table.names.push_back(name.get<std::string>());
  }
  table.columns.resize(table.names.size());
  for (const json& row : *data) {
    if (!row.is_array() || row.size() != table.names.size()) return {};
    for (std::size_t i = 0; i < row.size(); ++i) table.columns[i].push_back(&row[i]);
  }
  return table;
}

bool IsMissing(const json& value) {
  if (value.is_null()) return true;
  if (value.is_string()) return IsMissingReading(value.get_ref<const std::string&>());
  return value.is_number() && !(std::fabs(value.get<double>()) < kOverflowCode);
}

// Removes the rows without a voltage or a current and returns their number.
std::size_t DropMissing(const Channel& channel, JsonTable* table) {
  const std::size_t rows = table->columns[channel.voltage].size();
  if (table->columns[channel.current].size() != rows) return 0;
  std::vector<bool> missing(rows);
  for (const int side : {channel.voltage, channel.current}) {
    for (std::size_t i = 0; i < rows; ++i) {
      if (IsMissing(*table->columns[side][i])) missing[i] = true;
    }
  }
  for (std::vector<const json*>& column : table->columns) {
    if (column.size() != rows) continue;
    std::vector<const json*> kept;
    for (std::size_t i = 0; i < rows; ++i) {
      if (!missing[i]) kept.push_back(column[i]);
    }
    column = std::move(kept);
  }
  return std::count(missing.begin(), missing.end(), true);
}

// The curves found so far in a document.
struct FoundCurves {
  const std::string& path;
  const ReadOptions& options;
  std::vector<RawCurve> curves;
  std::set<std::string> ids;
};

std::vector<JsonTable> TablesOf(const json& node) {
  if (node.is_array()) return {FromRecords(node)};
  if (node.is_object()) return {FromLists(node), FromSplit(node), FromRecords(node)};
  return {};
}

// The curve's name in the document, or else `otherwise`.
std::string NameOf(const json& node, const std::string& otherwise) {
  for (const char* key : {"cell_name", "name", "id"}) {
    if (!node.is_object()) break;
    const auto found = node.find(key);
    if (found != node.end() && found->is_string()) return found->get<std::string>();
  }
  return otherwise;
}

Sidecar StatedNumbers(const json& object, const std::string& id, bool nomad) {
  TableHead head;
  for (const auto& [key, value] : object.items()) {
    const auto number = value.is_structured() ? std::nullopt : NumberOrText(value);
    if (!number) continue;
    const std::string label = nomad ? LabelInNomad(key) : key;
    TakeStatement(label, *number, Quoted(Below(id, key)), &head);
  }
  head.said.assumptions = HeadSentences(head);
  return head.said;
}

bool AllNumbers(const std::vector<const json*>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](const json* value) { return NumberOrText(*value).has_value(); });
}

void SayUnits(const Column& voltage, const Column& current, IvCurve* curve) {
  const bool density = current.kind == ColumnKind::kCurrentDensity;
  for (const auto& [column, unit] :
       {std::pair(&voltage, "V"), std::pair(&current, density ? "mA/cm2" : "A")}) {
    if (!column->unit.empty()) continue;
    curve->assumptions.push_back(
        fmt::format("{} names no unit: taken as {}", Quoted(column->label), unit));
  }
}

Expected<void> FillCurve(const std::string& path, const JsonTable& table,
                         const std::vector<Column>& columns, const Channel& channel,
                         IvCurve* curve) {
  std::vector<std::pair<int, std::vector<double>*>> wanted = {{channel.voltage, &curve->voltage_V},
                                                              {channel.current, &curve->current_A}};
  const std::pair<ColumnKind, std::vector<double>*> optional[] = {
      {ColumnKind::kSigma, &curve->sigma_A},
      {ColumnKind::kTime, &curve->time_s},
      {ColumnKind::kIrradiance, &curve->irradiance_W_m2},
      {ColumnKind::kTemperature, &curve->temperature_C}};
  const std::size_t points = table.columns[channel.voltage].size();
  for (const auto& [kind, values] : optional) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const bool usable = columns[i].kind == kind && columns[i].refusal.empty() &&
                          table.columns[i].size() == points && AllNumbers(table.columns[i]);
      if (usable && values->empty()) wanted.emplace_back(static_cast<int>(i), values);
    }
  }
  for (const auto& [place, values] : wanted) {
    const Column& column = columns[place];
    for (std::size_t i = 0; i < table.columns[place].size(); ++i) {
      const auto number = NumberOrText(*table.columns[place][i]);
      const double value = number ? *number * column.factor + column.offset : 0;
      if (!number) {
        return Fail(fmt::format("expected a finite number in \"{}\"[{}], found {}: if readings are "
                                "missing, leave them out with --skip-missing",
                                column.label, i, Quoted(OneLine(*table.columns[place][i]))),
                    path);
      }
      values->push_back(value);
    }
  }
  if (curve->voltage_V.size() != curve->current_A.size()) {
    return Fail(fmt::format("expected as many values in \"{}\" as in \"{}\", found {} and {}",
                            columns[channel.current].label, columns[channel.voltage].label,
                            curve->current_A.size(), curve->voltage_V.size()),
                path);
  }
  SayUnits(columns[channel.voltage], columns[channel.current], curve);
  return {};
}

std::string UniqueId(FoundCurves* found, const std::string& id) {
  std::string unique = id;
  for (int i = 2; !found->ids.insert(unique).second; ++i) unique = fmt::format("{} ({})", id, i);
  return unique;
}

// Adds the curves of a table. False if it has no pair of voltage and current.
Expected<bool> TakeTable(FoundCurves* found, const JsonTable& table, const std::string& id,
                         const Sidecar& around) {
  std::vector<Column> columns;
  for (const std::string& name : table.names) columns.push_back(RecogniseColumn(name));
  ApplyColumnWishes(found->options, &columns);
  const std::vector<Channel> channels = FindChannels(columns);
  if (channels.empty()) return false;
  std::vector<Channel> chosen = channels;
  if (!found->options.column.empty()) {
    const Expected<Channel> one = ChooseChannel(columns, channels, found->options.column);
    if (!one) return Fail(one.error().message, found->path);
    chosen = {*one};
  }
  for (const Channel& channel : chosen) {
    TRY(ApplyUnitWishes(found->options, channel, &columns));
    const std::string& label = columns[channel.current].label;
    const std::string own = Below(id, label);
    RawCurve raw;
    raw.stated = around;
    raw.per_area = columns[channel.current].kind == ColumnKind::kCurrentDensity;
    JsonTable rows = table;
    const std::size_t skipped = found->options.skip_missing ? DropMissing(channel, &rows) : 0;
    TRY(FillCurve(found->path, rows, columns, channel, &raw.curve));
    if (skipped > 0) {
      raw.curve.assumptions.push_back(fmt::format("{} of {} rows without a reading left out",
                                                  skipped, skipped + raw.curve.size()));
    }
    raw.curve.name = UniqueId(found, channels.size() > 1 ? own : id);
    raw.curve.source = found->path;
    TurnLoadSign(&raw.curve);
    found->curves.push_back(std::move(raw));
  }
  return true;
}

Expected<void> FindCurvesIn(FoundCurves* found, const json& node, const std::string& id,
                            Sidecar around, bool nomad) {
  if (node.is_object()) {
    nomad = nomad || node.contains("jv_curve");
    around = Merge(StatedNumbers(node, id, nomad), around);
  }
  for (const JsonTable& table : TablesOf(node)) {
    TRY(const bool taken, TakeTable(found, table, id, around));
    if (taken) return {};
  }
  if (!node.is_structured()) return {};
  std::size_t place = 0;
  for (auto item = node.begin(); item != node.end(); ++item, ++place) {
    if (!item->is_structured()) continue;
    const std::string key = node.is_object() ? item.key() : std::to_string(place);
    TRY(FindCurvesIn(found, *item, NameOf(*item, Below(id, key)), around, nomad));
  }
  return {};
}

}  // namespace

Expected<std::vector<RawCurve>> FindJsonCurves(const json& document, const std::string& path,
                                               const ReadOptions& options) {
  FoundCurves found{path, options, {}, {}};
  Sidecar around;
  if (IsReport(document)) around = ReportedConditions(document, path).value_or(Sidecar{});
  TRY(FindCurvesIn(&found, document, "", around, false));
  if (found.curves.empty()) {
    return Fail(
        "expected an ivcurves file (a JSON object with the key \"IV Curves\") or lists of numbers "
        "under names of a voltage and a current, such as \"voltage_V\" and \"current_A\"",
        path);
  }
  return std::move(found.curves);
}

}  // namespace lyrefit
