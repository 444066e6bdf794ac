#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/read/column.h"
#include "lyrefit/read/join_sweeps.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/read_table.h"
#include "lyrefit/read/sidecar.h"
#include "lyrefit/read/table_layout.h"
#include "lyrefit/read/table_lines.h"

namespace lyrefit {

// The current row of a table. Errors name file, line and column. The constructor's arguments must
// outlive the object.
class TableRow {
 public:
  TableRow(const std::vector<Column>& columns, char delimiter, const std::string& file)
      : columns_(columns), delimiter_(delimiter), file_(file), splitter_(delimiter) {}

  // Splits `line` into fields. Errors: quotes that do not close; not as many fields as columns.
  Expected<void> Take(std::string_view line, int number);

  // The two steps of Take.
  Expected<void> Split(std::string_view line, int number);
  Expected<void> CheckLength() const;

  std::string_view operator[](int field) const { return splitter_[field]; }
  int size() const { return static_cast<int>(splitter_.size()); }
  int number() const { return number_; }

  // The number in a field, converted to the unit of IvCurve.
  Expected<double> Value(int field);

  // The integer in a field of a column of whole numbers. A direction of a sweep, in words, is 1
  // (forward) or 2 (reverse).
  Expected<int> WholeNumber(int field);

  // Error such as "expected <expected> in column irradiance, found 'x'".
  tl::unexpected<Error> RefuseField(int field, std::string_view expected) const;

  // Error with any message, at the position of a field.
  tl::unexpected<Error> Refuse(std::string message, int field) const;

 private:
  tl::unexpected<Error> RefuseMissing(int field, std::string_view expected) const;
  std::string ColumnName(int field) const;
  Expected<void> CheckSeparator(int field, std::string_view text);

  const std::vector<Column>& columns_;
  char delimiter_;
  const std::string& file_;
  LineSplitter splitter_;
  std::string_view line_;
  int number_ = 0;
  char separator_ = '\0';
};

// Checks that the text is UTF-8. The error names the position of the first invalid byte.
Expected<void> CheckUtf8(std::string_view text, const std::string& file);

// One measurement of a table while it is read.
struct TableReading {
  ReadOptions options;  // that choose it
  TableLayout layout;
  Table table = {};
  std::vector<FurtherSweep> further = {};  // of the present table
  std::size_t padding = 0;                 // rows of zeros that were left out
  std::vector<std::size_t> starts = {};    // first rows of the second and later tables
  std::vector<Sidecar> heads = {};         // of the second and later tables

  // Appends a row. False if the measurement has nothing in this row. A row with a missing reading may
  // be skipped.
  Expected<bool> Take(TableRow* row);
  // Records the error of a row that was refused. False if the row's sweep cannot be read.
  bool SetAside(const Error& error, TableRow* row);

 private:
  Expected<bool> TakeFurther(std::size_t i, TableRow* row);
};

// Settles what needs all rows of a table: the curve of a Suns-Voc trace, the unit of a current that
// names none, the sweeps of tables one below the other, columns without a sensor.
Expected<void> SettleTable(std::string_view text, const std::string& file, TableReading* reading);

}  // namespace lyrefit
