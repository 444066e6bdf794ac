#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/read/column.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/table_columns.h"
#include "lyrefit/read/table_head.h"
#include "lyrefit/read/table_header.h"
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
  int device_column = kNoColumn;     // tells several devices apart: see FindDevices
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

// Position of a header or first row, for errors.
struct HeaderPlace {
  const std::string& file;
  int line;
  std::string_view text;
  char delimiter;

  tl::unexpected<Error> Refuse(std::string message, int column) const {
    return Fail(std::move(message), file, line, FieldColumn(text, delimiter, column));
  }
};

// Interprets the columns of a header. `next_line` is the line below it. The caller sets where the
// rows begin.
Expected<TableLayout> LayoutOfHeader(const TableLine& header, const HeaderPlace& place,
                                     std::string_view next_line, const ReadOptions& options);

// Builds the layout of a table without a header from its first row.
Expected<TableLayout> LayoutWithoutHeader(const TableLine& row, const HeaderPlace& place,
                                          const ReadOptions& options);

// Adds the sentence on the columns that are not used.
void SayWhatIsNotUsed(TableLayout* layout);

// Whether values of this column are read.
bool IsUsed(const TableLayout& layout, int column);

// The names as "'a', 'b'"; of many names only the first ones.
std::string ListOf(const Fields& names);

// Finds a column that tells devices apart ("Channel", "Pixel", "DUT") among those that are not used,
// and its values. They are few, and the rows of each cover at least half of all voltages, as the
// curve of a device does; a counter of samples does not. `rows` stands at the first row. Nothing is
// set where there is none, or one device alone.
void FindDevices(LineReader rows, TableLayout* layout);

}  // namespace lyrefit
