#pragma once

#include <string>
#include <vector>

#include "lyrefit/devices/cell_report.h"

namespace lyrefit {

// A number that tables have of one sweep of a cell.
struct CellField {
  const char* name;  // of its column
  const char* unit;
  const char* doc;
  double (*value)(const CellSweep& sweep);  // NaN: unknown, or void
};

// Key points, resistances and the fit's parameters of a sweep, in the order of the columns.
const std::vector<CellField>& CellFields();

// Why n and Rs of the fit of a sweep are void, joined with "; ".
std::string VoidReasons(const CellSweep& sweep);

}  // namespace lyrefit
