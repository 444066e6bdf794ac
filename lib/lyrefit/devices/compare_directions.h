// Experimental: may change in a minor version (data/stable).
#pragma once

#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/devices/cell_report.h"

namespace LYREFIT_PUBLIC lyrefit {

// Compares two lit sweeps of opposite directions under one light. Both must hold key points; the
// indices of the result are 0. `least_percent`: smallest gap that counts as hysteresis. Curves are
// interpolated linearly; the gap is the root mean square over 1001 even voltages, up to the end of
// the shorter sweep where that is below Voc. Sweeps may begin up to 5 % of Voc above 0 V.
DirectionPair CompareDirections(const CellSweep& forward, const CellSweep& reverse,
                                double least_percent);

// Pairs each forward with the next unpaired reverse sweep under its light (within 2 %), or the
// other way round.
std::vector<DirectionPair> FindPairs(const std::vector<CellSweep>& sweeps, double least_percent);

}  // namespace lyrefit
