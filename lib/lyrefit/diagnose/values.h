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
  double clip_level = 0;      // in scales; 0: none
  std::vector<int> clipped;   // readings
  bool limited = false;       // at the lower end too, as by a compliance limit
  double lower_limit = 0;     // in scales
  std::vector<int> at_lower;  // readings
  std::vector<int>
      at_voltage_limit;          // readings of currents that go on falling, above which none is
  double voltage_limit = 0;      // of these, per cell, V
  std::vector<double> rounding;  // of each reading: standard deviation of what a coarse grid adds
  double voltage_bin = 0;        // that the voltages were rounded to, per cell, V; 0: none
  std::vector<double> bin_rounding;  // of each reading: the same, in scales of the current
  double bins_shared = 1;            // by so many neighbours the error of a bin is shared

  bool HasLimits() const { return clip_level > 0 || limited || !at_voltage_limit.empty(); }
};

// The step of the grid on which all values lie, 0 if they lie on none that is coarser than a
// thousandth of their range. Values may be rounded to some digits beyond it.
double FindGrid(const std::vector<double>& values);

// Bins to which voltages were rounded when they were read. Readings that are evenly apart drift
// through their bins: neighbours err alike until a value is skipped or repeated.
struct VoltageBins {
  double step = 0;    // 0: the voltages lie on no grid or were set
  double shared = 1;  // so many readings
};

// A source that is told its voltages goes on in even steps, rounding makes them uneven or repeats a
// voltage.
VoltageBins FindBins(const Readings& readings);

// Clipping and grids, as the values themselves show them.
ValueFindings LookAtValues(const Readings& readings);

}  // namespace lyrefit
