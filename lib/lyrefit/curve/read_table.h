#pragma once

#include <string>
#include <string_view>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// The columns of a table as they stand in the file: every row, converted to the units of IvCurve,
// the sign of the current untouched.
struct Table {
  IvCurve curve;              // columns and assumptions only
  bool holds_curves = false;  // `sweep` comes from a column named curve
};

// `file` is only for the errors.
Expected<Table> ReadTable(std::string_view text, const std::string& file);

}  // namespace lyrefit
