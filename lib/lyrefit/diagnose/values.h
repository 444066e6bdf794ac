#pragma once

#include <vector>

#include "lyrefit/law/reading.h"

namespace lyrefit {

// Steps of the grids on which currents lie, in scales; 0: none.
struct Grids {
  double lit = 0;
  double dark = 0;
};

// What is read off the values before any fit.
struct ValueFindings {
  Grids grids;
  double clip_level = 0;         // in scales; 0: none
  std::vector<int> clipped;      // readings
  bool limited = false;          // at the lower end too, as by a compliance limit
  double lower_limit = 0;        // in scales
  std::vector<int> at_lower;     // readings
  std::vector<double> rounding;  // of each reading: standard deviation of what a coarse grid adds
};

// The step of the grid on which all values lie, 0 if they lie on none that is coarser than a
// thousandth of their range. Values may be rounded to some digits beyond it.
double FindGrid(const std::vector<double>& values);

// Clipping and grids, as the values themselves show them.
ValueFindings LookAtValues(const Readings& readings);

}  // namespace lyrefit
