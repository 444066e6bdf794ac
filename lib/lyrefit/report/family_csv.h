#pragma once

#include <string>

#include "lyrefit/family/family_report.h"

namespace lyrefit {

// The parameters of each curve as a table, in the columns of the parameter sets of
// github.com/cwhanse/ivcurves: Index, photocurrent, saturation_current, resistance_series,
// resistance_shunt, n, cells_in_series, and saturation_current_2 and n_2 for two diodes. Those of
// the curve's own fit, or, where that was not done, what the shared parameters come to. Numbers
// read back to the same bits; a curve without parameters keeps its row, empty.
std::string FreeFitsCsv(const FamilyReport& report);

}  // namespace lyrefit
