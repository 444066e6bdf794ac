#pragma once

#include <optional>
#include <vector>

#include "lyrefit/model/reading.h"

namespace lyrefit {

// Steps of the grids of the currents, in scales; 0: no grid.
struct Grids {
  double lit = 0;
  double dark = 0;
};

// Findings from the values of the readings, before any fit.
struct ValueFindings {
  Grids grids;
  double clip_level = 0;      // in scales; 0: none
  std::vector<int> clipped;   // readings
  bool limited = false;       // whether there is a lower limit too, such as a compliance limit
  double lower_limit = 0;     // in scales
  std::vector<int> at_lower;  // readings; without `limited`: of a noisy limit, left out
  std::vector<int> at_voltage_limit;  // readings at the largest voltage while the current falls on
  double voltage_limit = 0;           // that voltage, per cell, V
  std::vector<double> rounding;  // standard deviation of rounding to the current grid, per reading
  double voltage_bin = 0;        // step to which voltages were rounded, per cell, V; 0: none
  std::vector<double> bin_rounding;  // bin error of each reading as a current, in scales
  double bins_shared = 1;            // number of neighbours that share the error of a bin

  bool HasLimits() const { return clip_level > 0 || limited || !at_voltage_limit.empty(); }
};

// Step of the grid on which all values lie; 0 if there is none or it is finer than a ten-thousandth
// of the range. Values may be rounded to further digits.
double FindGrid(const std::vector<double>& values);

// Bins to which measured voltages were rounded. Readings at equal distances drift slowly through
// their bins, so that neighbours have nearly equal errors until a value is skipped or repeated.
struct VoltageBins {
  double step = 0;    // 0: no grid, or the voltages were set
  double shared = 1;  // number of neighbours that share an error
};

// Detects rounded voltages. Voltages set by a source change in even steps, while rounded ones have
// uneven steps or repeats.
VoltageBins FindBins(const Readings& readings);

// Finds clipping, grids and bins from the values alone. `readings` must not be empty. `limit`: of
// the current, as stated for the source, in scales.
ValueFindings LookAtValues(const Readings& readings, std::optional<double> limit = {});

// Whether the current rises with the voltage. No passive device does so, so that the light moved.
// Always false for sweeps up and down, where stored charge has the same effect.
bool LightMoved(const Readings& readings);

}  // namespace lyrefit
