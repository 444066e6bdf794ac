#include "lyrefit/curve/read_table.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "lyrefit/curve/number_text.h"
#include "lyrefit/curve/table_layout.h"
#include "lyrefit/curve/table_lines.h"

namespace lyrefit {
namespace {

// A column that is read and where its values go.
struct Slot {
  int field;
  std::vector<double>* values;
};

class RowReader {
 public:
  RowReader(const TableLayout& layout, const std::string& file, IvCurve* curve)
      : layout_(layout), file_(file), curve_(curve), splitter_(layout.delimiter) {
    slots_ = {{layout.voltage, &curve->voltage_V}, {layout.current, &curve->current_A}};
    if (layout.sigma != kNoColumn) slots_.push_back({layout.sigma, &curve->sigma_A});
    if (layout.time != kNoColumn) slots_.push_back({layout.time, &curve->time_s});
    if (layout.irradiance != kNoColumn) {
      slots_.push_back({layout.irradiance, &curve->irradiance_W_m2});
    }
    if (layout.temperature != kNoColumn) {
      slots_.push_back({layout.temperature, &curve->temperature_C});
    }
  }

  Expected<void> Read(std::string_view line, int number) {
    line_ = line;
    number_ = number;
    if (!splitter_.Split(line)) return Refuse("expected closed quotes", 0);
    if (auto checked = CheckLength(); !checked) return checked;
    for (const Slot& slot : slots_) {
      const Expected<double> value = Value(slot.field);
      if (!value) return tl::unexpected(value.error());
      slot.values->push_back(*value);
    }
    if (layout_.sweep == kNoColumn) return {};
    const Expected<double> value = Value(layout_.sweep);
    if (!value) return tl::unexpected(value.error());
    const bool whole = *value == std::floor(*value) && std::abs(*value) <= 1e9;
    if (!whole) return RefuseField(layout_.sweep, "a whole number");
    curve_->sweep.push_back(static_cast<int>(*value));
    return {};
  }

 private:
  std::string ColumnName(int field) const {
    const std::string& label = layout_.columns[field].label;
    if (!label.empty()) return "column " + label;
    return "column " + std::to_string(field + 1);
  }

  tl::unexpected<Error> Refuse(std::string message, std::size_t field) const {
    return Fail(std::move(message), file_, number_, FieldColumn(line_, layout_.delimiter, field));
  }

  tl::unexpected<Error> RefuseField(int field, std::string_view expected) const {
    const std::string_view text = splitter_[field];
    const std::string found = text.empty() ? "an empty field" : Quoted(text);
    return Refuse(fmt::format("expected {} in {}, found {}", expected, ColumnName(field), found),
                  field);
  }

  Expected<void> CheckLength() const {
    std::size_t size = splitter_.size();
    const std::size_t expected = layout_.columns.size();
    while (size > expected && splitter_[size - 1].empty()) --size;
    if (size == expected) return {};
    std::string hint;
    if (size == 2 * expected && layout_.delimiter == ',') {
      hint = " (with a decimal comma, separate the columns by ';' or tab)";
    }
    return Refuse(fmt::format("expected {} fields as in the first line of the table, found {}{}",
                              expected, size, hint),
                  size > expected ? expected : 0);
  }

  Expected<double> Value(int field) {
    const std::string_view text = splitter_[field];
    const auto number = ParseNumber(text, layout_.delimiter != ',');
    if (!number) return RefuseField(field, "a number");
    if (!std::isfinite(*number)) return RefuseField(field, "a finite number");
    if (auto checked = CheckSeparator(field, text); !checked) {
      return tl::unexpected(checked.error());
    }
    const Column& column = layout_.columns[field];
    const double value = *number * column.factor + column.offset;
    if (!std::isfinite(value)) return RefuseField(field, "a finite number");
    if (field == layout_.sigma && !(value > 0)) return RefuseField(field, "a positive number");
    if (field == layout_.temperature && (value > 150 || value < -100)) {
      return Refuse(fmt::format("expected a temperature in degrees Celsius in {}, found {}{}",
                                ColumnName(field), Quoted(text),
                                value > 150 ? ": looks like kelvin (name the column temperature_K)"
                                            : ": too cold for a cell"),
                    field);
    }
    return value;
  }

  // "1,234" beside "0.5" is a thousands separator, not a decimal comma.
  Expected<void> CheckSeparator(int field, std::string_view text) {
    if (layout_.delimiter == ',') return {};
    const char found = text.find(',') != std::string_view::npos   ? ','
                       : text.find('.') != std::string_view::npos ? '.'
                                                                  : '\0';
    if (found == '\0' || found == separator_) return {};
    if (separator_ == '\0') {
      separator_ = found;
      return {};
    }
    return RefuseField(field, fmt::format("a number with decimal '{}' as above", separator_));
  }

  const TableLayout& layout_;
  const std::string& file_;
  IvCurve* curve_;
  LineSplitter splitter_;
  std::vector<Slot> slots_;
  std::string_view line_;
  int number_ = 0;
  char separator_ = '\0';
};

Expected<void> CheckUtf8(std::string_view text, const std::string& file) {
  const auto bad = FirstInvalidUtf8(text);
  if (!bad) return {};
  int line = 1;
  std::size_t begin = 0;
  for (std::size_t at; (at = text.find('\n', begin)) < *bad; begin = at + 1) ++line;
  return Fail("expected UTF-8 text, found a byte of another encoding: save the file as UTF-8", file,
              line, static_cast<int>(*bad - begin) + 1);
}

}  // namespace

Expected<Table> ReadTable(std::string_view text, const std::string& file) {
  if (auto checked = CheckUtf8(text, file); !checked) return tl::unexpected(checked.error());
  const Expected<TableLayout> layout = FindTableLayout(text, file);
  if (!layout) return tl::unexpected(layout.error());
  Table table;
  table.curve.assumptions = layout->assumptions;
  table.holds_curves =
      layout->sweep != kNoColumn && layout->columns[layout->sweep].kind == ColumnKind::kCurve;
  RowReader reader(*layout, file, &table.curve);
  LineReader lines(text, layout->first_row_offset, layout->first_row_line);
  std::string_view line;
  while (lines.NextContent(&line)) {
    if (auto read = reader.Read(line, lines.number()); !read) return tl::unexpected(read.error());
  }
  if (table.curve.size() == 0) {
    return Fail("expected rows of numbers below the header, found none", file,
                layout->first_row_line);
  }
  return table;
}

}  // namespace lyrefit
