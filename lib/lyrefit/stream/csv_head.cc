#include "lyrefit/stream/csv_head.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/date_time.h"
#include "lyrefit/read/guess_columns.h"
#include "lyrefit/read/spreadsheet_text.h"
#include "lyrefit/read/table_columns.h"
#include "lyrefit/read/table_lines.h"
#include "lyrefit/read/text_encoding.h"
#include "lyrefit/stream/row_curve.h"
#include "lyrefit/stream/row_names.h"

namespace lyrefit {
namespace {

constexpr std::size_t kLookedAtRows = 20;

std::vector<std::string> Split(std::string_view line, char delimiter) {
  LineSplitter splitter(delimiter);
  std::vector<std::string> fields;
  if (!splitter.Split(line)) return fields;
  for (std::size_t i = 0; i < splitter.size(); ++i) fields.emplace_back(TrimBlanks(splitter[i]));
  while (!fields.empty() && fields.back().empty()) fields.pop_back();
  return fields;
}

// The names as columns, with the columns named by the options.
std::vector<Column> ColumnsOf(const std::vector<std::string>& names, const ReadOptions& options) {
  std::vector<Column> columns;
  columns.reserve(names.size());
  for (const std::string& name : names) columns.push_back(MeaningOf(name).column);
  ApplyColumnWishes(options, &columns);
  if (FindChannels(columns).empty()) GuessColumns(&columns);
  return columns;
}

// Columns of the id: a complete id, else all levels, else any name.
std::vector<int> IdColumns(const std::vector<std::string>& names) {
  std::array<int, static_cast<std::size_t>(IdPart::kOtherwise) + 1> places;
  places.fill(-1);
  for (std::size_t i = 0; i < names.size(); ++i) {
    int& place = places[static_cast<std::size_t>(MeaningOf(names[i]).id)];
    if (place == -1) place = static_cast<int>(i);
  }
  const int whole = places[static_cast<std::size_t>(IdPart::kWhole)];
  const int otherwise = places.back();
  if (whole != -1) return {whole};
  std::vector<int> columns;
  for (auto part = static_cast<std::size_t>(IdPart::kSite); part + 1 < places.size(); ++part) {
    if (places[part] != -1) columns.push_back(places[part]);
  }
  if (columns.empty() && otherwise != -1) columns = {otherwise};
  return columns;
}

// Shape of the table, from the rows below a header.
CsvShape ShapeOfRows(const CsvHead& head, const std::vector<Column>& columns,
                     const std::vector<std::string_view>& rows) {
  const std::vector<Channel> channels = FindChannels(columns);
  int single = 0;
  for (std::size_t k = 0; k < std::min(kLookedAtRows, rows.size()); ++k) {
    const std::vector<std::string> fields = Split(rows[k], head.delimiter);
    for (std::size_t i = 0; i < fields.size() && i < head.names.size(); ++i) {
      Records pairs;
      const bool may_be = MeaningOf(head.names[i]).pairs || fields[i].find('#') < fields[i].size();
      if (may_be && ParsePairs(fields[i], 1, &pairs)) return CsvShape::kRows;
    }
    if (channels.empty()) continue;
    const auto voltage = static_cast<std::size_t>(channels[0].voltage);
    const auto current = static_cast<std::size_t>(channels[0].current);
    if (std::max(voltage, current) >= fields.size()) continue;
    // "8,5" between semicolons is one number.
    const bool comma = head.delimiter != ',';
    if (ParseNumber(fields[voltage], comma) && ParseNumber(fields[current], comma)) {
      ++single;
    } else if (IsList(fields[voltage]) || IsList(fields[current])) {
      return CsvShape::kRows;
    }
  }
  return single > 0 && !head.id_columns.empty() ? CsvShape::kLong : CsvShape::kNone;
}

// True if a first line is already a row, since it holds a list.
bool IsRowWithoutHead(std::string_view line) {
  for (const char delimiter : kFieldMarks) {
    const std::vector<std::string> fields = Split(line, delimiter);
    if (fields.size() < 2) continue;
    const auto lists = std::count_if(fields.begin(), fields.end(),
                                     [](const std::string& field) { return IsList(field); });
    if (lists >= 2) return true;
  }
  return false;
}

// The raw field that begins at `at`. `at` is set to the beginning of the next field; npos at the
// end.
std::string_view TakeField(std::string_view row, char delimiter, std::size_t* at) {
  std::size_t begin = *at;
  std::size_t stop = begin;
  while (stop < row.size() && (row[stop] == ' ' || (row[stop] == '\t' && delimiter != '\t'))) {
    ++stop;
  }
  if (stop < row.size() && row[stop] == '"') {
    begin = stop;
    do {
      stop = row.find('"', stop + 1);
      if (stop != std::string_view::npos && stop + 1 < row.size() && row[stop + 1] == '"') {
        ++stop;
        continue;
      }
      break;
    } while (true);
    if (stop == std::string_view::npos) stop = row.size();
  }
  stop = std::min(row.find(delimiter, stop), row.size());
  *at = stop >= row.size() ? std::string_view::npos : stop + 1;
  return TrimBlanks(row.substr(begin, stop - begin));
}

std::string Unquoted(std::string_view field) {
  if (field.size() < 2 || field.front() != '"' || field.back() != '"') {
    return WithoutApostrophe(AsUtf8(field));
  }
  std::string text;
  for (std::size_t i = 1; i + 1 < field.size(); ++i) {
    text += field[i];
    if (field[i] == '"' && field[i + 1] == '"') ++i;
  }
  return WithoutApostrophe(AsUtf8(TrimBlanks(text)));
}

// Adds a field to the lists or to the scalars.
Expected<void> TakeCsvField(const CsvHead& head, std::size_t place, std::string_view text,
                            int column, Records* fields) {
  const std::string& name = head.names[place];
  const char delimiter = head.delimiter;
  const NameMeaning& meaning = MeaningOf(name);
  const std::string_view trimmed = TrimBlanks(text);
  if (meaning.more && !trimmed.empty() && trimmed.front() == '{') {
    auto parsed = ParseJsonRow(trimmed, fields);
    if (!parsed) return Fail("in \"more\": " + parsed.error().message, "", 0, column);
    return {};
  }
  if (meaning.pairs && ParsePairs(text, column, fields)) return {};
  const bool named = meaning.column.kind != ColumnKind::kUnrecognised || head.readings[place];
  const bool reading = named && IsList(text) && !(delimiter != ',' && ParseNumber(trimmed, true));
  const bool electrical = IsElectrical(meaning.column.kind) && !trimmed.empty();
  if (reading || electrical) {
    Record list;
    list.name = name;
    list.column = column;
    ParseList(text, column, &list);
    fields->lists.push_back(std::move(list));
    return {};
  }
  if (text.find('#') != std::string_view::npos && ParsePairs(text, column, fields)) return {};
  fields->scalars.push_back({name, ScalarText(trimmed, delimiter), false, column});
  return {};
}

// Completes an id that stands in several rows by their times, if these tell them apart.
void CompleteId(const std::vector<std::string_view>& rows, CsvHead* head) {
  const auto are_unique = [&](const CsvHead& of) {
    std::set<std::string> ids;
    return std::all_of(rows.begin(), rows.end(), [&](std::string_view row) {
      return ids.insert(IdOfCsvRow(row, of)).second;
    });
  };
  if (head->id_columns.empty() || are_unique(*head)) return;
  for (std::size_t i = 0; i < head->names.size(); ++i) {
    const bool times = std::all_of(rows.begin(), rows.end(), [&](std::string_view row) {
      const std::vector<std::string> fields = Split(row, head->delimiter);
      return i < fields.size() && ReadDateTime(fields[i]);
    });
    if (!times) continue;
    CsvHead completed = *head;
    completed.time_column = static_cast<int>(i);
    completed.id_columns.push_back(completed.time_column);
    if (!are_unique(completed)) continue;
    *head = std::move(completed);
    return;
  }
}

}  // namespace

std::string ScalarText(std::string_view text, char delimiter) {
  std::string scalar = WithoutApostrophe(AsUtf8(text));
  if (delimiter == ',' || ParseNumber(scalar)) return scalar;
  const std::size_t comma = scalar.find(',');
  if (comma != std::string::npos && ParseNumber(scalar, true)) scalar[comma] = '.';
  return scalar;
}

std::string AsUtf8(std::string_view text) {
  if (!FirstInvalidUtf8(text)) return std::string(text);
  auto decoded = DecodeText(std::string(text), "");
  return decoded ? decoded->text : std::string();
}

CsvHead FindCsvHead(std::string_view text, const ReadOptions& options) {
  LineReader lines(text);
  std::string_view line;
  CsvHead head;
  if (!lines.NextContent(&line)) return head;
  head.line = lines.number();
  std::vector<std::string_view> rows;
  std::string_view row;
  while (lines.Next(&row)) {
    if (!TrimBlanks(row).empty()) rows.push_back(row);
  }
  if (rows.size() > kLookedAtRows) rows.pop_back();  // it may end in the midst
  for (const char delimiter : kFieldMarks) {
    CsvHead candidate = head;
    candidate.delimiter = delimiter;
    candidate.names = Split(AsUtf8(line), delimiter);
    if (candidate.names.size() < 2) continue;
    const std::vector<Column> columns = ColumnsOf(candidate.names, options);
    candidate.id_columns = IdColumns(candidate.names);
    candidate.shape = ShapeOfRows(candidate, columns, rows);
    if (candidate.shape == CsvShape::kNone) continue;
    for (const Column& column : columns) candidate.readings.push_back(IsElectrical(column.kind));
    if (candidate.shape == CsvShape::kRows) CompleteId(rows, &candidate);
    return candidate;
  }
  if (IsRowWithoutHead(line)) head.shape = CsvShape::kNoHead;
  return head;
}

std::string IdOfCsvRow(std::string_view row, const CsvHead& head, std::size_t* looked_at) {
  if (looked_at != nullptr) *looked_at = row.size();
  if (head.id_columns.empty()) return "";
  const int last = *std::max_element(head.id_columns.begin(), head.id_columns.end());
  std::vector<std::string_view> fields;
  std::size_t at = 0;
  while (static_cast<int>(fields.size()) <= last) {
    if (at == std::string_view::npos) return "";
    fields.push_back(TakeField(row, head.delimiter, &at));
  }
  if (looked_at != nullptr && at != std::string_view::npos) *looked_at = at;
  if (head.id_columns.size() == 1) {
    const std::string text = Unquoted(fields[head.id_columns[0]]);
    const IdPart part = MeaningOf(head.names[head.id_columns[0]]).id;
    return part == IdPart::kWhole || part == IdPart::kOtherwise ? text : AsLevel(text);
  }
  std::string id;
  for (const int column : head.id_columns) {
    const std::string level = AsLevel(Unquoted(fields[column]));
    if (!level.empty()) id += (id.empty() ? "" : "/") + level;
  }
  return id;
}

Expected<void> ParseCsvRow(std::string_view row, const CsvHead& head, Records* fields) {
  if (const std::size_t zero = row.find('\0'); zero != std::string_view::npos) {
    return Fail("expected text, found a zero byte", "", 0, static_cast<int>(zero) + 1);
  }
  LineSplitter splitter(head.delimiter);
  if (!splitter.Split(row)) return Fail("expected closed quotes in one line", "", 0, 1);
  std::size_t size = splitter.size();
  while (size > head.names.size() && TrimBlanks(splitter[size - 1]).empty()) --size;
  if (size != head.names.size()) {
    return Fail(
        fmt::format("expected {} fields as in the header, found {}", head.names.size(), size), "",
        0, 1);
  }
  std::size_t at = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const int column = static_cast<int>(at) + 1;
    TRY(TakeCsvField(head, i, splitter[i], column, fields));
    if (at != std::string_view::npos) TakeField(row, head.delimiter, &at);
  }
  return {};
}

}  // namespace lyrefit
