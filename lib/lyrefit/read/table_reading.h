#pragma once

#include <cstddef>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/read/join_sweeps.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/read_table.h"
#include "lyrefit/read/sidecar.h"
#include "lyrefit/read/table_layout.h"
#include "lyrefit/read/table_row.h"

namespace lyrefit {

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

}  // namespace lyrefit
