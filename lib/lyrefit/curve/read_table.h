#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// The columns of a table as they stand in the file: every row, converted to the units of IvCurve,
// the sign of the current untouched.
struct Table {
  IvCurve curve;                // columns and assumptions only
  bool holds_curves = false;    // `sweep` comes from a column named curve
  std::vector<int> lines;       // where each row stands
  std::map<int, Error> broken;  // sweeps with a row that could not be read: their first error
};

enum class BrokenRows {
  kRefuse,   // the first one is the answer
  kSetAside  // in `broken`, as long as the row tells its sweep
};

// `file` is only for the errors.
Expected<Table> ReadTable(std::string_view text, const std::string& file,
                          BrokenRows broken_rows = BrokenRows::kRefuse);

}  // namespace lyrefit
