#pragma once

#include <vector>

#include "lyrefit/curve/check_readings.h"
#include "lyrefit/curve/key_points.h"

namespace lyrefit {

using Findings = std::vector<ReadingFinding>;

inline constexpr double kLowestCell_V = 0.2;
inline constexpr double kHighestCell_V = 1.6;   // where no technology is stated
inline constexpr double kHighestStack_V = 5.5;  // of one cell with several junctions

// Quantities that the checks after LookForOverflow and LookForNothing share.
struct Examined {
  const IvCurve& curve;
  KeyPoints key;
  double largest_A = 0;
  double largest_V = 0;
  double delivered_A = 0;  // the largest current at forward voltage
  bool lit = false;
};

// Checks the voltage of a cell under light against what cells and the stated technology give.
void LookAtCells(const Examined& look, Findings* out);

}  // namespace lyrefit
