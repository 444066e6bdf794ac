#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/column.h"
#include "lyrefit/curve/table_lines.h"

namespace lyrefit {

// The row of a table that is being read; its errors name file, line and column. What it is made
// from has to outlive it.
class TableRow {
 public:
  TableRow(const std::vector<Column>& columns, char delimiter, const std::string& file)
      : columns_(columns), delimiter_(delimiter), file_(file), splitter_(delimiter) {}

  // Takes the fields of `line`: as many as there are columns.
  Expected<void> Take(std::string_view line, int number);

  std::string_view operator[](int field) const { return splitter_[field]; }
  int number() const { return number_; }

  // The number in a field, in the unit of IvCurve.
  Expected<double> Value(int field);

  // The same for a column of whole numbers.
  Expected<int> WholeNumber(int field);

  // "expected <expected> in column irradiance, found 'x'".
  tl::unexpected<Error> RefuseField(int field, std::string_view expected) const;

  // Any message, at the place of a field.
  tl::unexpected<Error> Refuse(std::string message, int field) const;

 private:
  tl::unexpected<Error> RefuseMissing(int field, std::string_view expected) const;
  std::string ColumnName(int field) const;
  Expected<void> CheckLength() const;
  Expected<void> CheckSeparator(int field, std::string_view text);

  const std::vector<Column>& columns_;
  char delimiter_;
  const std::string& file_;
  LineSplitter splitter_;
  std::string_view line_;
  int number_ = 0;
  char separator_ = '\0';
};

// The text has to be UTF-8: the error names the place of the first byte that is not.
Expected<void> CheckUtf8(std::string_view text, const std::string& file);

}  // namespace lyrefit
