#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/read/table_lines.h"

namespace lyrefit {

// A small table whose columns are identified by name and may be in any order.
class NamedTable {
 public:
  // Reads the file and its header. All `columns` must exist.
  Expected<void> Open(const std::string& path, const std::vector<std::string>& columns);

  // The next row; false at the end of the file.
  Expected<bool> Next();

  // A field of the current row; `column` is the position of its column in `columns`.
  std::string operator[](int column) const { return std::string(fields_[position_[column]]); }

  // An error "expected ..., found '...'" with file, line and column of the field.
  tl::unexpected<Error> Refuse(int column, const std::string& expected) const;

 private:
  std::string path_;
  std::string text_;
  std::optional<LineReader> lines_;
  LineSplitter fields_{','};
  std::string_view line_;
  std::vector<int> position_;
};

}  // namespace lyrefit
