#pragma once

#include <vector>

#include "hidden/field_sampled.h"

namespace hidden::field {

struct BypassDiode {
  double saturation_A = 1e-5;
  double scale_V = 0.027;  // ideality times thermal voltage
  double series_ohm = 0.01;
};

enum class Bypass { kWorks, kOpen, kShorted };

// Cells one after the other, in a half-cut module twice side by side, and one bypass diode over
// them.
struct Group {
  std::vector<std::vector<Cell>> chains;
  BypassDiode diode;
  Bypass bypass = Bypass::kWorks;
  double short_ohm = 3e-3;
};

// Groups in series.
struct Module {
  std::vector<Group> groups;
  int CellsInSeries() const;
  double LargestPhotocurrent() const;  // of a group's chains together
};

// The curve of the module while all its light is `light` times what its cells state: from a little
// below 0 V to more than 3 % beyond the open circuit, currents to a millionth of the largest.
Sampled CurveOf(const Module& module, double light = 1);

}  // namespace hidden::field
