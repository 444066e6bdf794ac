#pragma once

#include <vector>

#include "faults/field_sampled.h"

namespace faults::field {

struct BypassDiode {
  double saturation_A = 1e-5;
  double scale_V = 0.027;  // ideality times thermal voltage
  double series_ohm = 0.01;
};

enum class Bypass { kWorks, kOpen, kShorted };

// Cells in series with one bypass diode across them. A half-cut module has two such chains in
// parallel per group.
struct Group {
  std::vector<std::vector<Cell>> chains;
  BypassDiode diode;
  Bypass bypass = Bypass::kWorks;
  double short_ohm = 3e-3;
  bool broken = false;  // no chain carries current
};

// Groups in series.
struct Module {
  std::vector<Group> groups;
  int CellsInSeries() const;
  double LargestPhotocurrent() const;  // A; sum over the parallel chains of a group
};

// Curve of the module with the photocurrent of every cell multiplied by `light`. It runs from
// slightly below 0 V to more than 3 % beyond open circuit. Currents are accurate to a millionth of
// the largest.
Sampled CurveOf(const Module& module, double light = 1);

}  // namespace faults::field
