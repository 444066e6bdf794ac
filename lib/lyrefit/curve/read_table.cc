#include "lyrefit/curve/read_table.h"

#include "lyrefit/curve/table_layout.h"
#include "lyrefit/curve/table_lines.h"
#include "lyrefit/curve/table_row.h"

namespace lyrefit {
namespace {

// A column that is read and where its values go.
struct Slot {
  int field;
  std::vector<double>* values;
};

class RowReader {
 public:
  RowReader(const TableLayout& layout, const std::string& file, Table* table)
      : layout_(layout), row_(layout.columns, layout.delimiter, file), table_(table) {
    IvCurve* curve = &table->curve;
    slots_ = {{layout.voltage, &curve->voltage_V}, {layout.current, &curve->current_A}};
    if (layout.sigma != kNoColumn) slots_.push_back({layout.sigma, &curve->sigma_A});
    if (layout.time != kNoColumn) slots_.push_back({layout.time, &curve->time_s});
    if (layout.irradiance != kNoColumn) {
      slots_.push_back({layout.irradiance, &curve->irradiance_W_m2});
    }
    if (layout.temperature != kNoColumn) {
      slots_.push_back({layout.temperature, &curve->temperature_C});
    }
    values_.resize(slots_.size());
  }

  // Appends the row, or nothing of it.
  Expected<void> Read(std::string_view line, int number) {
    if (auto taken = row_.Take(line, number); !taken) return taken;
    for (std::size_t i = 0; i < slots_.size(); ++i) {
      const Expected<double> value = row_.Value(slots_[i].field);
      if (!value) return tl::unexpected(value.error());
      values_[i] = *value;
    }
    if (layout_.sweep != kNoColumn) {
      const Expected<int> sweep = row_.WholeNumber(layout_.sweep);
      if (!sweep) return tl::unexpected(sweep.error());
      table_->curve.sweep.push_back(*sweep);
    }
    for (std::size_t i = 0; i < slots_.size(); ++i) slots_[i].values->push_back(values_[i]);
    table_->lines.push_back(number);
    return {};
  }

  // Remembers the row that Read refused, if it can be told whose it is.
  bool SetAside(std::string_view line, int number, const Error& error) {
    if (layout_.sweep == kNoColumn || !row_.Take(line, number)) return false;
    const Expected<int> sweep = row_.WholeNumber(layout_.sweep);
    if (sweep) table_->broken.try_emplace(*sweep, error);
    return sweep.has_value();
  }

 private:
  const TableLayout& layout_;
  TableRow row_;
  Table* table_;
  std::vector<Slot> slots_;
  std::vector<double> values_;
};

}  // namespace

Expected<Table> ReadTable(std::string_view text, const std::string& file, BrokenRows broken_rows) {
  if (auto checked = CheckUtf8(text, file); !checked) return tl::unexpected(checked.error());
  const Expected<TableLayout> layout = FindTableLayout(text, file);
  if (!layout) return tl::unexpected(layout.error());
  Table table;
  table.curve.assumptions = layout->assumptions;
  table.curve.voltage_unit_known = !layout->columns[layout->voltage].unit.empty();
  table.curve.current_unit_known = !layout->columns[layout->current].unit.empty();
  table.holds_curves =
      layout->sweep != kNoColumn && layout->columns[layout->sweep].kind == ColumnKind::kCurve;
  RowReader reader(*layout, file, &table);
  LineReader lines(text, layout->first_row_offset, layout->first_row_line);
  std::string_view line;
  while (lines.NextContent(&line)) {
    const auto read = reader.Read(line, lines.number());
    const bool go_on = read || (broken_rows == BrokenRows::kSetAside &&
                                reader.SetAside(line, lines.number(), read.error()));
    if (!go_on) return tl::unexpected(read.error());
  }
  if (table.curve.size() == 0 && table.broken.empty()) {
    return Fail("expected rows of numbers below the header, found none", file,
                layout->first_row_line);
  }
  return table;
}

}  // namespace lyrefit
