#pragma once

#include <vector>

#include "lyrefit/devices/two_junction_problem.h"
#include "lyrefit/search/search_summary.h"

namespace lyrefit {

// Variables of the search: photocurrents in parts of what short circuit tells, the share of
// junction 1 in the open-circuit voltage, both idealities, Rs and the logarithms of the shunts. A
// saturation current follows from its junction's share of the open-circuit voltage.
Box TwoJunctionBox(const PreparedTwoJunctions& prepared);

// Parameters of the problem at a point of the box, inside the bounds.
std::vector<double> ParametersAt(const PreparedTwoJunctions& prepared, const double* x);

// Points of the box from the shape of the curves: the pairs of photocurrents that come nearest to
// the short-circuit currents of all curves, with shares of the voltage and idealities.
std::vector<std::vector<double>> TwoJunctionStarts(const PreparedTwoJunctions& prepared);

}  // namespace lyrefit
