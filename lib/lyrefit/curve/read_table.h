#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/read_curve.h"
#include "lyrefit/curve/sidecar.h"

namespace lyrefit {

// The columns of a table as they stand in the file: every row, converted to the units of IvCurve,
// the sign of the current untouched.
struct Table {
  IvCurve curve;                // columns and assumptions only
  bool holds_curves = false;    // `sweep` comes from a column named curve
  std::vector<int> lines;       // where each row stands
  std::vector<int> skipped;     // lines without a reading that were left out
  std::map<int, Error> broken;  // sweeps with a row that could not be read: their first error
  Sidecar head;                 // what the lines before the header state
  bool per_area = false;        // the currents are in A/cm2
  std::string current_label;    // of the column of the currents
};

enum class BrokenRows {
  kRefuse,   // the first one is the answer
  kSetAside  // in `broken`, as long as the row tells its sweep
};

// Reads a table and the further ones below it, which become sweeps of their own; text below the
// last row is left, and said in `assumptions`. `file` is only for the errors.
Expected<Table> ReadTable(std::string_view text, const std::string& file,
                          const ReadOptions& options = {},
                          BrokenRows broken_rows = BrokenRows::kRefuse);

}  // namespace lyrefit
