#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/sidecar.h"

namespace lyrefit {

// The columns of a table: every row in file order, converted to the units of IvCurve, with the
// currents' original sign.
struct Table {
  IvCurve curve;                // columns and assumptions only
  bool holds_curves = false;    // `sweep` comes from a column named curve
  std::vector<int> lines;       // line of each row in the file
  std::vector<int> skipped;     // lines of missing readings that were left out
  std::map<int, Error> broken;  // first error of each sweep with an invalid row
  Sidecar head;                 // conditions stated in lines before the header
  bool per_area = false;        // the currents are in A/cm2
  std::string name;             // of the measurement, by its columns: ChannelName; or its device
  bool of_device = false;       // the rows of one device of several
  std::optional<Error> error;   // why the measurement cannot be used, though others beside it can
};

enum class BrokenRows {
  kRefuse,   // the first one is the error of the table
  kSetAside  // record it in `broken` if the row's sweep can be read
};

// Reads a table and further tables below it, which become separate sweeps. Text below the last row
// is ignored, and `assumptions` mentions it. `file` is only used in errors.
Expected<Table> ReadTable(std::string_view text, const std::string& file,
                          const ReadOptions& options = {},
                          BrokenRows broken_rows = BrokenRows::kRefuse);

// Reads each measurement side by side as a table of its own, or only the one that the options name.
// An invalid reading of one of several measurements is in the `error` of its table.
Expected<std::vector<Table>> ReadTables(std::string_view text, const std::string& file,
                                        const ReadOptions& options, BrokenRows broken_rows);

}  // namespace lyrefit
