#include "lyrefit/curve/table_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "lyrefit/curve/number_text.h"
#include "lyrefit/curve/table_header.h"
#include "lyrefit/curve/table_lines.h"

namespace lyrefit {
namespace {

constexpr int kLargestPreamble = 200;  // lines of text before the header

std::string ListOf(const Fields& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + Quoted(name);
  return list;
}

struct Place {
  const std::string& file;
  int line;
  std::string_view text;
  char delimiter;

  tl::unexpected<Error> Refuse(std::string message, int column) const {
    return Fail(std::move(message), file, line, FieldColumn(text, delimiter, column));
  }
};

// The column of `kind`: the usable one if there is one, the refused one if it is the only.
Expected<int> PickColumn(const TableLayout& layout, ColumnKind kind, const Place& place) {
  int usable = kNoColumn;
  int refused = kNoColumn;
  const bool required = kind == ColumnKind::kVoltage || kind == ColumnKind::kCurrent;
  for (int i = 0; i < static_cast<int>(layout.columns.size()); ++i) {
    const Column& column = layout.columns[i];
    if (column.kind != kind) continue;
    if (!column.refusal.empty()) {
      if (refused == kNoColumn) refused = i;
    } else if (usable == kNoColumn) {
      usable = i;
    } else if (required) {
      return place.Refuse(fmt::format("expected one {} column, found two: {} and {}",
                                      kind == ColumnKind::kVoltage ? "voltage" : "current",
                                      Quoted(layout.columns[usable].label), Quoted(column.label)),
                          i);
    }
  }
  if (usable == kNoColumn && refused != kNoColumn) {
    return place.Refuse(layout.columns[refused].refusal, refused);
  }
  return usable;
}

Expected<void> PickColumns(TableLayout* layout, const Place& place) {
  const std::pair<ColumnKind, int*> wanted[] = {{ColumnKind::kVoltage, &layout->voltage},
                                                {ColumnKind::kCurrent, &layout->current},
                                                {ColumnKind::kSigma, &layout->sigma},
                                                {ColumnKind::kTime, &layout->time},
                                                {ColumnKind::kSweep, &layout->sweep},
                                                {ColumnKind::kIrradiance, &layout->irradiance},
                                                {ColumnKind::kTemperature, &layout->temperature}};
  for (const auto& [kind, index] : wanted) {
    const Expected<int> picked = PickColumn(*layout, kind, place);
    if (!picked) return tl::unexpected(picked.error());
    *index = *picked;
  }
  if (layout->sweep == kNoColumn) layout->sweep = *PickColumn(*layout, ColumnKind::kCurve, place);
  if (layout->current == kNoColumn) {
    const Expected<int> density = PickColumn(*layout, ColumnKind::kCurrentDensity, place);
    if (!density) return tl::unexpected(density.error());
  }
  return {};
}

// A time of day or a label is no use to us, but no reason to refuse the curve.
void DropTextColumns(std::string_view row, TableLayout* layout) {
  const auto fields = SplitFields(row, layout->delimiter);
  if (!fields || layout->time == kNoColumn) return;
  const std::size_t time = layout->time;
  if (time >= fields->size() || (*fields)[time].empty()) return;
  if (!ParseNumber((*fields)[time], layout->delimiter != ',')) layout->time = kNoColumn;
}

bool IsUsed(const TableLayout& layout, int column) {
  for (const int used : {layout.voltage, layout.current, layout.sigma, layout.time, layout.sweep,
                         layout.irradiance, layout.temperature}) {
    if (used == column) return true;
  }
  return false;
}

void SayWhatWasAssumed(TableLayout* layout) {
  Fields unused;
  for (int i = 0; i < static_cast<int>(layout->columns.size()); ++i) {
    const Column& column = layout->columns[i];
    if (!IsUsed(*layout, i)) {
      if (!column.label.empty()) unused.push_back(column.label);
    } else if (column.offset != 0) {
      layout->assumptions.push_back(
          fmt::format("column {} converted from kelvin to degrees Celsius", Quoted(column.label)));
    } else if (column.factor != 1) {
      layout->assumptions.push_back(fmt::format("column {} multiplied by {} to get {}",
                                                Quoted(column.label), column.factor,
                                                column.kind == ColumnKind::kVoltage      ? "V"
                                                : column.kind == ColumnKind::kTime       ? "s"
                                                : column.kind == ColumnKind::kIrradiance ? "W/m2"
                                                                                         : "A"));
    }
  }
  for (const auto& [index, unit] : {std::pair(layout->voltage, "V"), {layout->current, "A"}}) {
    const Column& column = layout->columns[index];
    if (!column.unit.empty() || column.label.empty()) continue;
    layout->assumptions.push_back(
        fmt::format("column {} names no unit: taken as {}", Quoted(column.label), unit));
  }
  if (!unused.empty()) {
    layout->assumptions.push_back(
        fmt::format("column{} not used: {}", unused.size() == 1 ? "" : "s", ListOf(unused)));
  }
}

Expected<TableLayout> FromHeader(const TableLine& header, const Place& place,
                                 std::string_view next_line) {
  TableLayout layout;
  layout.delimiter = header.delimiter;
  layout.columns = header.columns;
  if (auto picked = PickColumns(&layout, place); !picked) return tl::unexpected(picked.error());
  DropTextColumns(next_line, &layout);
  SayWhatWasAssumed(&layout);
  return layout;
}

Expected<TableLayout> WithoutHeader(const TableLine& row, const Place& place) {
  // "0,5,7,48" may be two numbers with decimal commas.
  const bool may_be_decimal_commas =
      row.delimiter == ',' && row.fields.size() == 4 &&
      std::all_of(row.fields.begin(), row.fields.end(), [](const std::string& field) {
        return field.find_first_of(".eE") == std::string::npos;
      });
  if (may_be_decimal_commas) {
    return place.Refuse(
        "expected two columns, found four whole numbers without a header: with a decimal comma, "
        "separate the columns by ';' or tab",
        0);
  }
  TableLayout layout;
  layout.delimiter = row.delimiter;
  layout.columns.resize(row.fields.size());
  layout.voltage = 0;
  layout.current = 1;
  layout.assumptions.push_back(
      "no header line: column 1 taken as the voltage in V, column 2 as the current in A");
  if (row.fields.size() > 2) {
    layout.assumptions.push_back(fmt::format("{} further columns not used", row.fields.size() - 2));
  }
  return layout;
}

// Why nothing could be made of the file, at the line that comes nearest to a header.
Error NoLayout(std::string_view line, int number, const std::string& file) {
  const std::string expected =
      "expected a header with a voltage and a current, such as "
      "voltage_V,current_A";
  if (number == 0) return Error{"the file holds no data, only blank lines and comments", file};
  TableLine widest;
  for (const char delimiter : kDelimiters) {
    const auto fields = SplitFields(line, delimiter);
    if (fields && fields->size() > std::max<std::size_t>(1, widest.fields.size())) {
      widest = {delimiter, *fields, RecogniseAll(*fields)};
    }
  }
  if (widest.delimiter == 0) {
    const char* what = ParseNumber(line, true) ? "a table of one column" : "one field";
    return Error{fmt::format("{}, found {}: {}", expected, what, Quoted(line)), file, number, 1};
  }
  std::string missing = "neither";
  if (HasKind(widest.columns, ColumnKind::kVoltage)) missing = "no current";
  if (HasKind(widest.columns, ColumnKind::kCurrent)) missing = "no voltage";
  return Error{fmt::format("{}, found {} among {}", expected, missing, ListOf(widest.fields)), file,
               number, 1};
}

// The search for the first line that is a header or, without one, the first row.
class LayoutSearch {
 public:
  LayoutSearch(std::string_view text, const std::string& file) : lines_(text), file_(file) {}

  Expected<TableLayout> Run() {
    std::size_t offset = 0;
    while (skipped_ <= kLargestPreamble && NextContent(&offset)) {
      std::string_view next_line;
      LineReader ahead = lines_;
      ahead.NextContent(&next_line);
      const TableLine header = AsHeader(line_, next_line);
      if (header.delimiter != 0 && (header.fits || !second_best_)) {
        auto layout = Finish(FromHeader(header, PlaceOf(header), next_line), lines_.offset(),
                             lines_.number());
        if (header.fits) return layout;
        second_best_ = std::move(layout);
      }
      const TableLine row = AsRow(line_);
      if (row.delimiter != 0 && skipped_ == 0) {
        return Finish(FromRow(row), offset, lines_.number() - 1);
      }
      if (row.delimiter != 0) return GiveUp(last_text_, last_text_number_);
      Skip();
    }
    return GiveUp(first_text_, first_text_number_);
  }

 private:
  Place PlaceOf(const TableLine& found) const {
    return {file_, lines_.number(), line_, found.delimiter};
  }

  // Like LineReader's, but remembers comments and where the line began.
  bool NextContent(std::size_t* offset) {
    while (true) {
      *offset = lines_.offset();
      if (!lines_.Next(&line_)) return false;
      const std::size_t first = line_.find_first_not_of(" \t");
      if (first == std::string_view::npos) continue;
      if (line_[first] != '#') return true;
      comment_ = line_;
    }
  }

  void Skip() {
    if (skipped_++ == 0) {
      first_text_ = line_;
      first_text_number_ = lines_.number();
    }
    last_text_ = line_;
    last_text_number_ = lines_.number();
  }

  Expected<TableLayout> FromRow(const TableLine& row) const {
    const TableLine header = HeaderInComment(comment_, line_);
    if (header.delimiter == 0) return WithoutHeader(row, PlaceOf(row));
    Expected<TableLayout> layout = FromHeader(header, PlaceOf(header), line_);
    if (layout) {
      layout->assumptions.push_back("column names taken from the comment above the numbers");
    }
    return layout;
  }

  // A header without numbers below it is still better than none: its rows tell what is wrong.
  Expected<TableLayout> GiveUp(std::string_view line, int number) const {
    if (second_best_) return *second_best_;
    return tl::unexpected(NoLayout(line, number, file_));
  }

  Expected<TableLayout> Finish(Expected<TableLayout> layout, std::size_t offset,
                               int lines_before) const {
    if (!layout) return layout;
    layout->first_row_offset = offset;
    layout->first_row_line = lines_before;
    if (skipped_ > 0) {
      layout->assumptions.insert(layout->assumptions.begin(),
                                 fmt::format("{} line{} before the header in line {} skipped",
                                             skipped_, skipped_ == 1 ? "" : "s", lines_.number()));
    }
    return layout;
  }

  LineReader lines_;
  const std::string& file_;
  std::string_view line_;
  std::string_view comment_;
  std::string_view first_text_;
  int first_text_number_ = 0;
  std::string_view last_text_;
  int last_text_number_ = 0;
  std::optional<Expected<TableLayout>> second_best_;
  int skipped_ = 0;  // lines of text, not counting comments
};

}  // namespace

Expected<TableLayout> FindTableLayout(std::string_view text, const std::string& file) {
  return LayoutSearch(text, file).Run();
}

}  // namespace lyrefit
