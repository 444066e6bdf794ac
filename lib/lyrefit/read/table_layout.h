#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/read/column.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/table_columns.h"
#include "lyrefit/read/table_head.h"
#include "lyrefit/read/table_lines.h"

namespace lyrefit {

constexpr int kNoColumn = -1;

// Layout of a table: delimiter, begin of the rows, and meaning of the columns.
struct TableLayout {
  char delimiter = ',';
  std::size_t first_row_offset = 0;  // where reading the rows begins
  int first_row_line = 0;            // lines before that offset
  std::vector<Column> columns;       // one for each header field
  std::vector<Channel> channels;     // measurements side by side; only one is read
  std::vector<ColumnPair> more;      // further sweeps of the measurement that is read
  int voltage = kNoColumn;
  int current = kNoColumn;
  int sigma = kNoColumn;
  int time = kNoColumn;
  int sweep = kNoColumn;  // a `sweep` or `curve` column
  int irradiance = kNoColumn;
  int temperature = kNoColumn;
  int device_column = kNoColumn;     // tells several devices apart: see device_column.h
  std::vector<std::string> devices;  // its values
  std::string device;                // the one that is read
  TableHead head;                    // statements of the lines before the header
  std::vector<Assumption> assumptions;

  // The measurement that is read.
  Channel channel() const {
    Channel read(voltage, current);
    read.more = more;
    return read;
  }
  bool per_area() const { return columns[current].kind == ColumnKind::kCurrentDensity; }
};

// Finds the header among the first lines, after any text that a tracer writes before it, or
// determines that there is none. `file` is only used in errors.
Expected<TableLayout> FindTableLayout(std::string_view text, const std::string& file,
                                      const ReadOptions& options = {});

// Finds the header of a further table in the rest of `lines`. It needs numbers below it and none
// before it.
Expected<TableLayout> FindNextLayout(LineReader lines, const std::string& file,
                                     const ReadOptions& options);

// The measurements of a table, channels side by side or devices one below the other, by the values
// of ReadOptions::column that choose them.
std::vector<std::string> MeasurementsOf(const TableLayout& layout);

}  // namespace lyrefit
