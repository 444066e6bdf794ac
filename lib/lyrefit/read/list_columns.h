#pragma once

#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/table_view.h"

namespace lyrefit {

// A table of a text as it stands, the layout that the reader finds in it, and its columns.
struct ListedTable {
  TableView view;                // without a delimiter: there is no table
  Expected<TableLayout> layout;  // or why the reader finds none
  std::vector<ColumnNote> columns = {};
};

ListedTable ListTable(std::string_view text, const std::string& file, const ReadOptions& options);

}  // namespace lyrefit
