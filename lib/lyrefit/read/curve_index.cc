#include "lyrefit/read/curve_index.h"

#include <fmt/format.h>

#include <filesystem>
#include <string_view>
#include <utility>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/settle_conditions.h"
#include "lyrefit/read/table_curve.h"
#include "lyrefit/read/table_header.h"
#include "lyrefit/read/table_layout.h"
#include "lyrefit/read/table_lines.h"
#include "lyrefit/read/table_row.h"
#include "lyrefit/read/text_encoding.h"

namespace lyrefit {
namespace {

struct IndexLayout {
  char delimiter = ',';
  std::vector<Column> columns;
  int id = kNoColumn;
  int irradiance = kNoColumn;
  int temperature = kNoColumn;
  int date = kNoColumn;
};

bool Contains(const std::string& text, std::string_view part) {
  return LowerCase(text).find(part) != std::string::npos;
}

// A column `file` has priority, since a column `curve` beside it may be a mere count.
int FindId(const std::vector<Column>& columns, IndexIds ids) {
  int found = kNoColumn;
  for (int i = 0; i < static_cast<int>(columns.size()); ++i) {
    if (ids == IndexIds::kFiles && LowerCase(columns[i].label) == "file") return i;
    const bool numbers =
        columns[i].kind == ColumnKind::kCurve || columns[i].kind == ColumnKind::kSweep;
    if (numbers && found == kNoColumn) found = i;
  }
  return found;
}

// The first usable column of the kind. A column whose label contains `lesser` is used only if there
// is no other.
int FindCondition(const std::vector<Column>& columns, ColumnKind kind, std::string_view lesser) {
  int found = kNoColumn;
  for (int i = 0; i < static_cast<int>(columns.size()); ++i) {
    if (columns[i].kind != kind) continue;
    const bool better = found == kNoColumn ||
                        (!columns[found].refusal.empty() && columns[i].refusal.empty()) ||
                        (Contains(columns[found].label, lesser) &&
                         !Contains(columns[i].label, lesser) && columns[i].refusal.empty());
    if (better) found = i;
  }
  return found;
}

// The first column named as a date.
int FindDate(const std::vector<Column>& columns) {
  for (int i = 0; i < static_cast<int>(columns.size()); ++i) {
    const std::string label = LowerCase(columns[i].label);
    for (const char* name : {"timestamp", "date", "datetime", "time"}) {
      if (label == name) return i;
    }
  }
  return kNoColumn;
}

Expected<IndexLayout> FindIndexLayout(std::string_view header, int line, const std::string& path,
                                      IndexIds ids) {
  for (const char delimiter : kDelimiters) {
    const auto fields = SplitFields(header, delimiter);
    if (!fields) continue;
    IndexLayout layout;
    layout.delimiter = delimiter;
    layout.columns = RecogniseAll(*fields);
    layout.id = FindId(layout.columns, ids);
    if (layout.id == kNoColumn) continue;
    layout.irradiance = FindCondition(layout.columns, ColumnKind::kIrradiance, "module");
    layout.temperature = FindCondition(layout.columns, ColumnKind::kTemperature, "module");
    layout.date = FindDate(layout.columns);
    for (const int used : {layout.irradiance, layout.temperature}) {
      if (used == kNoColumn || layout.columns[used].refusal.empty()) continue;
      return Fail(layout.columns[used].refusal, path, line, FieldColumn(header, delimiter, used));
    }
    return layout;
  }
  return Fail(fmt::format("expected a header with a column curve{}, found {}",
                          ids == IndexIds::kFiles ? " or file" : "", Quoted(header)),
              path, line, 1);
}

// The rows of an index while they are read.
struct IndexRows {
  const IndexLayout& layout;
  IndexIds ids;
  TableRow row;
  CurveIndex index;
};

Expected<std::string> IdOfRow(IndexRows* rows) {
  const std::string_view text = rows->row[rows->layout.id];
  if (text.empty()) return rows->row.RefuseField(rows->layout.id, "the id of a curve");
  if (rows->ids == IndexIds::kNumbers) {
    TRY(const int number, rows->row.WholeNumber(rows->layout.id));
    return std::to_string(number);
  }
  const std::filesystem::path file{std::string(text)};
  return IsTable(file) ? file.stem().string() : std::string(text);
}

Expected<std::optional<double>> NumberOfRow(IndexRows* rows, int field) {
  if (field == kNoColumn || rows->row[field].empty()) return std::optional<double>();
  TRY(const double value, rows->row.Value(field));
  return std::optional<double>(value);
}

Expected<void> ReadIndexRow(IndexRows* rows, std::string_view line, int number) {
  TRY(rows->row.Take(line, number));
  TRY(const std::string id, IdOfRow(rows));
  IndexRow row;
  row.missing =
      rows->row
          .Refuse(fmt::format("expected rows of curves that are there, found one of curve {}",
                              Quoted(id)),
                  rows->layout.id)
          .value();
  const auto irradiance = NumberOfRow(rows, rows->layout.irradiance);
  if (!irradiance) return tl::unexpected(irradiance.error());
  row.irradiance_W_m2 = *irradiance;
  if (irradiance->value_or(0) < -kLargestDarkOffset_W_m2) {
    return rows->row.RefuseField(rows->layout.irradiance, "an irradiance from 0 W/m2 up");
  }
  TRY(row.temperature_C, NumberOfRow(rows, rows->layout.temperature));
  if (rows->layout.date != kNoColumn) row.date = std::string(rows->row[rows->layout.date]);
  if (!rows->index.rows.try_emplace(id, std::move(row)).second) {
    return rows->row.Refuse(
        fmt::format("expected one row a curve, found a second one of curve {}", Quoted(id)),
        rows->layout.id);
  }
  return {};
}

// Records which conditions the index states, and the conversions of its columns.
void DescribeColumns(const IndexLayout& layout, CurveIndex* index) {
  index->states_irradiance = layout.irradiance != kNoColumn;
  index->states_temperature = layout.temperature != kNoColumn;
  for (const int used : {layout.irradiance, layout.temperature}) {
    if (used == kNoColumn) continue;
    const std::string& label = layout.columns[used].label;
    if (layout.columns[used].offset != 0) {
      index->assumptions.push_back(fmt::format(
          "column {} of the index converted from kelvin to degrees Celsius", Quoted(label)));
    }
    if (Contains(label, "module") && used == layout.temperature) {
      index->assumptions.push_back(fmt::format(
          "column {} of the index taken as the temperature of the cells", Quoted(label)));
    }
  }
}

}  // namespace

Expected<CurveIndex> ReadCurveIndex(const std::string& path, IndexIds ids,
                                    const ReadOptions& options) {
  TRY(const DecodedText text, ReadDecodedFile(path, options.largest_file_bytes));
  LineReader lines(text.text);
  std::string_view line;
  if (!lines.NextContent(&line)) {
    return Fail("the file holds no data, only blank lines and comments", path);
  }
  TRY(const IndexLayout layout, FindIndexLayout(line, lines.number(), path, ids));
  IndexRows rows{layout, ids, TableRow(layout.columns, layout.delimiter, path), {}};
  while (lines.NextContent(&line)) {
    TRY(ReadIndexRow(&rows, line, lines.number()));
  }
  DescribeColumns(layout, &rows.index);
  return std::move(rows.index);
}

}  // namespace lyrefit
