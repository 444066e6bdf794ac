#include "lyrefit/read/results_above.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <utility>

#include "lyrefit/base/median.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/read/label.h"
#include "lyrefit/read/stated_results.h"

namespace lyrefit {
namespace {

constexpr char kResultsDelimiter = '\t';

int PlaceOfName(const Fields& names, std::string_view wanted) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (ResultName(names[i]) == wanted) return static_cast<int>(i);
  }
  return -1;
}

// Median of |reading / stated value| over the sweeps; 0 if there is none.
double SizeOver(const ResultsAbove& results, int place, const Fields& readings) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < results.rows.size(); ++i) {
    const auto stated = ParseNumber(results.rows[i][place]);
    const auto read = ParseNumber(readings[i + 1]);
    if (stated && read && *stated != 0) ratios.push_back(std::abs(*read / *stated));
  }
  return ratios.empty() ? 0 : UpperMedian(ratios);
}

// The unit of the currents: that of the stated Jsc or Isc, whichever is nearer to the readings.
Column UnitByResults(const ResultsAbove& results, const Fields& readings) {
  constexpr double kFarthest = 100;
  Column nearest;
  double distance = std::log(kFarthest);
  for (const auto& [name, kind] :
       {std::pair("jsc", ColumnKind::kCurrentDensity), std::pair("isc", ColumnKind::kCurrent)}) {
    const int place = PlaceOfName(results.names, name);
    if (place == -1) continue;
    const std::vector<LabelWord> words = SplitLabel(results.names[place]);
    const Unit* unit = nullptr;
    for (std::size_t from = 1; from < words.size() && unit == nullptr; ++from) {
      unit = FindUnit(kind, JoinWords(words, from, words.size()));
    }
    const double away = std::abs(std::log(SizeOver(results, place, readings)));
    if (unit == nullptr || !(away < distance)) continue;
    distance = away;
    nearest.kind = kind;
    nearest.unit = unit->text;
    nearest.factor = unit->factor;
  }
  return nearest;
}

// Adds the values of the last row of results to those of the head.
void KeepValues(const ResultsAbove& results, int number, TableHead* head) {
  const Fields& row = results.rows.back();
  std::string name = row.back();
  // The last field that is not empty names the sweep; some rows end in empty fields.
  for (std::size_t i = row.size(); name.empty() && i > 0; --i) name = row[i - 1];
  for (std::size_t i = 0; i < results.names.size(); ++i) {
    const auto value = ParseNumber(row[i]);
    if (!value || !IsResult(results.names[i])) continue;
    head->result_lines.push_back({results.names[i],
                                  {name},
                                  {*value},
                                  fmt::format("line {} {}", number, Quoted(results.names[i]))});
  }
}

}  // namespace

bool TakeResults(std::string_view line, int number, ResultsAbove* results, TableHead* head) {
  auto fields = SplitFields(line, kResultsDelimiter);
  if (!fields || fields->size() < 3) return false;
  if (AreKeyPoints(*fields)) {
    *results = {std::move(*fields), {}};
    return true;
  }
  if (results->names.empty() || fields->size() != results->names.size()) return false;
  if (!ParseNumber((*fields)[0])) return false;
  results->rows.push_back(std::move(*fields));
  KeepValues(*results, number, head);
  if (results->rows.size() > 1) return true;
  for (std::size_t i = 0; i < results->names.size(); ++i) {
    const auto value = ParseNumber(results->rows[0][i]);
    const std::string source = fmt::format("line {} {}", number, Quoted(results->names[i]));
    if (value && std::isfinite(*value)) TakeStatement(results->names[i], *value, source, head);
  }
  return true;
}

TableLine HeaderBelowResults(const ResultsAbove& results, std::string_view line,
                             std::string_view next_line) {
  const auto fields = SplitFields(line, kResultsDelimiter);
  const auto readings = SplitFields(next_line, kResultsDelimiter);
  if (!fields || !readings || results.rows.empty()) return {};
  const std::size_t sweeps = results.rows.size();
  if (fields->size() != sweeps + 1 || readings->size() != sweeps + 1) return {};
  const auto is_number = [](const std::string& field) { return ParseNumber(field).has_value(); };
  if (!std::all_of(readings->begin(), readings->end(), is_number)) return {};
  if (!std::all_of(fields->begin() + 1, fields->end(), is_number)) return {};
  const Column voltage = RecogniseColumn(fields->front().substr(0, fields->front().find('/')));
  const Column current = UnitByResults(results, *readings);
  if (voltage.kind != ColumnKind::kVoltage || current.kind == ColumnKind::kUnrecognised) return {};
  TableLine header{kResultsDelimiter, {}, {voltage}, true};
  for (const Fields& row : results.rows) {
    Column column = current;
    column.label = row.back();
    column.tag = ReadTag(row.back());
    header.columns.push_back(column);
  }
  for (const Column& column : header.columns) header.fields.push_back(column.label);
  return header;
}

void TakeGroupNames(std::string_view above, TableLine* header) {
  const std::vector<Channel> channels = FindChannels(header->columns);
  if (channels.size() < 2) return;
  std::vector<Column>& columns = header->columns;
  if (columns[channels[0].current].label != columns[channels[1].current].label) return;
  const auto fields = SplitFields(above, header->delimiter);
  if (!fields) return;
  std::set<std::string> names;
  for (const Channel& channel : channels) {
    const auto place = static_cast<std::size_t>(std::min(channel.voltage, channel.current));
    if (place >= fields->size() || (*fields)[place].empty()) return;
    if (ParseNumber((*fields)[place]) || !names.insert((*fields)[place]).second) return;
  }
  for (const Channel& channel : channels) {
    const std::string& name = (*fields)[std::min(channel.voltage, channel.current)];
    for (const int place : {channel.voltage, channel.current}) {
      columns[place].tag = ReadTag(name);
      columns[place].label = name + " " + columns[place].label;
    }
  }
}

namespace {

// The fields from one column up to, not including, another.
struct Span {
  std::size_t begin, end;
};

std::size_t FirstColumn(const ColumnPair& pair) { return std::min(pair.voltage, pair.current); }

// The fields above a pair: up to the next pair to the right.
std::optional<Span> SpanOf(const std::vector<Channel>& channels, const ColumnPair& own) {
  Span span{FirstColumn(own), std::string_view::npos};
  for (const Channel& other : channels) {
    const bool is_own = other.voltage == own.voltage && other.current == own.current;
    if (!is_own && other.voltage == own.voltage) return std::nullopt;
    if (FirstColumn(other) > span.begin) span.end = std::min(span.end, FirstColumn(other));
  }
  return span;
}

// The own fields of a line whose label stands above every pair; none if it does not.
std::optional<Fields> OwnFields(std::string_view line, char delimiter,
                                const std::vector<Channel>& channels, const Span& own) {
  const auto fields = SplitFields(line, delimiter);
  if (!fields || own.begin >= fields->size()) return std::nullopt;
  const std::string& label = (*fields)[own.begin];
  const bool everywhere = std::all_of(channels.begin(), channels.end(), [&](const Channel& one) {
    return FirstColumn(one) < fields->size() && (*fields)[FirstColumn(one)] == label;
  });
  if (label.empty() || !everywhere || ParseNumber(label, true)) return std::nullopt;
  const std::size_t end = std::min(own.end, fields->size());
  return Fields(fields->begin() + static_cast<std::ptrdiff_t>(own.begin),
                fields->begin() + static_cast<std::ptrdiff_t>(end));
}

std::string Joined(const Fields& fields, char delimiter) {
  std::string line;
  for (const std::string& field : fields)
    line += (line.empty() ? "" : std::string(1, delimiter)) + field;
  return line;
}

// Takes what the value of a line without a number says of the light, whatever its label.
void TakeLightOf(const Fields& fields, int number, TableHead* head) {
  for (std::size_t i = 1; i < fields.size(); ++i) {
    TakeLight(fields[i], fmt::format("line {} {}", number, Quoted(fields[i])), head);
  }
}

}  // namespace

bool ReadOwnHead(const std::vector<LineOfHead>& lines, char delimiter,
                 const std::vector<Channel>& channels, const ColumnPair& own, TableHead* all) {
  const auto span = channels.size() > 1 ? SpanOf(channels, own) : std::nullopt;
  if (!span) return false;
  TableHead head;
  std::vector<std::pair<Fields, int>> parts;
  for (const LineOfHead& line : lines) {
    auto fields = OwnFields(line.text, delimiter, channels, *span);
    const std::string part = fields ? Joined(*fields, delimiter) : std::string(line.text);
    ReadHeadLine(part, line.number, line.kind, &head);
    if (fields) parts.emplace_back(std::move(*fields), line.number);
  }
  for (const auto& [fields, number] : parts) TakeLightOf(fields, number, &head);
  if (parts.empty()) return false;
  head.results = std::move(all->results);
  head.result_lines = std::move(all->result_lines);
  *all = std::move(head);
  return true;
}

}  // namespace lyrefit
