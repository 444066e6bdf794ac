#pragma once

#include <vector>

#include "lyrefit/devices/cell_report.h"

// Which sweeps of a cell a figure is made of. Results are positions in CellReport::sweeps.
namespace lyrefit {

// Isc of a sweep that passes 0 V; else NaN.
double ReachedIsc(const CellSweep& sweep);

// Brightest lit sweep, of equals the first; -1: none is lit.
int BrightestOf(const std::vector<CellSweep>& sweeps);

// First sweep of this kind, one of the direction of `like` before others; -1: none.
int FindSweep(const CellReport& report, SweepKind kind, const CellSweep& like);

// Lit sweeps of the direction of `main`, one a light, the brightest first. Those count that `isc_of`
// gives an Isc.
std::vector<int> LightsOf(const CellReport& report, double (*isc_of)(const CellSweep&));

// Lit sweeps of the light of `main`, of both directions.
std::vector<int> BrightestSweeps(const CellReport& report);

}  // namespace lyrefit
