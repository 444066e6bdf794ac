#pragma once

#include <vector>

#include "faults/cell.h"

namespace faults {

struct CellGroup {
  Cell cell;
  int count = 1;
};

// Cells in series with an optional bypass diode across them. The string contains `copies` of it.
struct Substring {
  std::vector<CellGroup> groups;
  int copies = 1;
  bool bypassed = false;
  bool ideal = false;  // the diode voltage is `drop` at any current
  double drop = 0.5;   // V, at `drop_current`
  double drop_current = 1;
};

double StringCurrent(const std::vector<Substring>& string, double voltage);

}  // namespace faults
