#pragma once

#include <vector>

#include "lyrefit/diagnose/select.h"
#include "lyrefit/law/reading.h"

namespace lyrefit {

// The step of the grid on which all values lie, 0 if they lie on none that is coarser than a
// thousandth of their range. Values may be rounded to some digits beyond it.
double FindGrid(const std::vector<double>& values);

// Clipping and grids, as the values themselves show them.
ValueFindings LookAtValues(const Readings& readings, const std::vector<char>& dark);

}  // namespace lyrefit
