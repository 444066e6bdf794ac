#include <fmt/format.h>

#include <cmath>

#include "lyrefit/inspect/inspect.h"
#include "lyrefit/read/json_text.h"
#include "lyrefit/report/json_parts.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

constexpr std::size_t kMostColumns = 60;
constexpr std::size_t kMostLines = 40;
constexpr std::size_t kLongestText = 60, kLongestName = 36, kLongestValue = 20;

std::string Number(double value) { return std::isnan(value) ? "-" : fmt::format("{:.5g}", value); }

std::string Shortened(const std::string& text, std::size_t longest = kLongestText) {
  if (text.size() <= longest) return text;
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80U) --end;
  return text.substr(0, end) + " ...";
}

Section HeadOf(const Inspection& found) {
  Section head = {found.file};
  AddField("holds", found.form, &head);
  if (!found.encoding.empty()) AddField("encoding", found.encoding, &head);
  if (found.first_row_line > 0) {
    const std::string header =
        found.header_line == 0 ? "no header" : fmt::format("header in line {}", found.header_line);
    AddField("table",
             fmt::format("{}, {} from line {} on; separator {}, decimal {}", header,
                         Plural(static_cast<std::size_t>(found.rows), "row"), found.first_row_line,
                         found.separator, found.decimal),
             &head);
  }
  if (found.curve_count > 0) AddField("curves", std::to_string(found.curve_count), &head);
  return head;
}

Section Columns(const Inspection& found) {
  Section section = {"Columns"};
  block::Table table;
  table.alignment = "rlllrrw";
  table.heads = {{"", "name", "read as", "unit", "least", "largest", "first values"}};
  for (const ColumnNote& column : found.columns) {
    if (table.rows.size() == kMostColumns) break;
    std::string first;
    for (const std::string& value : column.first) {
      first += (first.empty() ? "" : "  ") + Shortened(value, kLongestValue);
    }
    table.rows.push_back({std::to_string(column.place), Shortened(column.name, kLongestName),
                          column.use, column.unit, Number(column.least), Number(column.largest),
                          first});
  }
  if (table.rows.empty()) return section;
  AddTable(std::move(table), &section);
  if (found.columns.size() > kMostColumns) {
    AddSentence(fmt::format("{} more columns.", found.columns.size() - kMostColumns), &section);
  }
  return section;
}

Section HeadLines(const Inspection& found) {
  Section section = {"Lines above the table"};
  block::Table table;
  table.alignment = "rlw";
  table.heads = {{"line", "taken", "text"}};
  for (const HeadLineNote& note : found.head) {
    if (table.rows.size() == kMostLines) break;
    table.rows.push_back(
        {std::to_string(note.line), note.taken.empty() ? "-" : note.taken, Shortened(note.text)});
  }
  if (table.rows.empty()) return section;
  AddTable(std::move(table), &section);
  if (found.head.size() > kMostLines) {
    AddSentence(fmt::format("{} more lines.", found.head.size() - kMostLines), &section);
  }
  return section;
}

Section Curves(const Inspection& found) {
  Section section = {"Curves"};
  block::Table table;
  table.alignment = "rlrrrrrrlw";
  table.heads = {
      {"", "name", "points", "from V", "to V", "Isc (A)", "Voc (V)", "W/m2", "scan", "kind"}};
  for (const CurveNote& curve : found.curves) {
    const KeyPoints& points = curve.key_points;
    table.rows.push_back(
        {std::to_string(table.rows.size() + 1), Shortened(curve.name, kLongestName),
         std::to_string(curve.points), Number(curve.least_V), Number(curve.largest_V),
         Number(points.short_circuit_current_A), Number(points.open_circuit_voltage_V),
         Number(curve.irradiance_W_m2.value_or(kUnknown)), curve.direction,
         curve.kind.words.empty() ? ToText(curve.kind.kind) : curve.kind.words});
  }
  if (table.rows.empty()) return section;
  AddTable(std::move(table), &section);
  if (found.curve_count > found.curves.size()) {
    AddSentence(fmt::format("{} more curves.", found.curve_count - found.curves.size()), &section);
  }
  return section;
}

Section Values(const Inspection& found) {
  Section section = {"The module"};
  for (const auto& [name, text] : found.values) AddField(name, text, &section);
  return section;
}

Section Missing(const Inspection& found) {
  Section section = {found.refusal.empty() ? "Not stated" : "Not read as it is"};
  if (!found.refusal.empty()) AddSentence(FullSentence(found.refusal), &section);
  block::Table table;
  table.alignment = "lw";
  table.heads = {{"flag", found.refusal.empty() ? "says" : "with it"}};
  for (const WayOut& way : found.missing) table.rows.push_back({way.flag, way.what});
  if (!table.rows.empty()) AddTable(std::move(table), &section);
  return section;
}

Json JsonOf(const ColumnNote& column) {
  return {{"place", column.place},     {"name", column.name},       {"use", column.use},
          {"unit", column.unit},       {"numbers", column.numbers}, {"least", column.least},
          {"largest", column.largest}, {"first", column.first}};
}

Json JsonOf(const CurveNote& curve) {
  const KeyPoints& points = curve.key_points;
  const auto known = [](const std::optional<double>& value) {
    return value ? Json(*value) : Json();
  };
  return {{"name", curve.name},
          {"points", curve.points},
          {"least_V", curve.least_V},
          {"largest_V", curve.largest_V},
          {"isc_A", points.short_circuit_current_A},
          {"voc_V", points.open_circuit_voltage_V},
          {"pmp_W", points.max_power_W},
          {"kind", ToText(curve.kind.kind)},
          {"kind_words", curve.kind.words},
          {"direction", curve.direction},
          {"irradiance_Wm2", known(curve.irradiance_W_m2)},
          {"cell_temperature_C", known(curve.temperature_C)}};
}

Json JsonOf(const Inspection& found) {
  Json columns = Json::array(), head = Json::array(), curves = Json::array(),
       missing = Json::array(), values = Json::object();
  for (const ColumnNote& column : found.columns) columns.push_back(JsonOf(column));
  for (const HeadLineNote& note : found.head) {
    head.push_back({{"line", note.line}, {"text", note.text}, {"taken", note.taken}});
  }
  for (const CurveNote& curve : found.curves) curves.push_back(JsonOf(curve));
  for (const WayOut& way : found.missing) {
    missing.push_back({{"flag", way.flag}, {"what", way.what}});
  }
  for (const auto& [name, text] : found.values) values[name] = text;
  return {{"file", found.file},
          {"form", found.form},
          {"encoding", found.encoding},
          {"separator", found.separator},
          {"decimal", found.decimal},
          {"header_line", found.header_line},
          {"first_row_line", found.first_row_line},
          {"rows", found.rows},
          {"columns", columns},
          {"head", head},
          {"curve_count", found.curve_count},
          {"curves", curves},
          {"values", values},
          {"refusal", found.refusal},
          {"missing", missing},
          {"doubts", found.doubts},
          {"assumed", found.assumed},
          {"next", found.next}};
}

Document InspectionDocument(const Inspection& found) {
  Document document;
  document.head = HeadOf(found);
  AddSections({Columns(found), HeadLines(found), Values(found), Curves(found), Missing(found),
               ListSection("Doubts", found.doubts), ListSection("Assumed", found.assumed),
               ListSection("What reads it", found.next)},
              &document);
  return document;
}

}  // namespace

std::string InspectionText(const Inspection& inspection) {
  return DrawText(InspectionDocument(inspection));
}

std::string InspectionJson(const std::vector<Inspection>& inspections) {
  Json all = Json::array();
  for (const Inspection& one : inspections) all.push_back(JsonOf(one));
  return Dump(inspections.size() == 1 ? all.front() : all);
}

}  // namespace lyrefit
