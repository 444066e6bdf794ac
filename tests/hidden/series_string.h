#pragma once

#include <vector>

#include "hidden/cell.h"

namespace hidden {

struct CellGroup {
  Cell cell;
  int count = 1;
};

// Cells in series, perhaps with a bypass diode across them, `copies` times in the string.
struct Substring {
  std::vector<CellGroup> groups;
  int copies = 1;
  bool bypassed = false;
  bool ideal = false;  // the diode holds its drop whatever the current
  double drop = 0.5;   // V, at `drop_current`
  double drop_current = 1;
};

double StringCurrent(const std::vector<Substring>& string, double voltage);

}  // namespace hidden
