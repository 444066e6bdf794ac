#pragma once

#include <map>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/devices/two_junction_model.h"
#include "lyrefit/devices/two_junction_options.h"

namespace lyrefit {

// A problem of two junctions with what its starts and its report need.
struct PreparedTwoJunctions {
  TwoJunctionProblem problem;
  std::vector<StatedLight> light;  // of each curve, as used
  std::vector<double> isc_A;       // of each curve, from its readings
  double voc_V = 0;                // largest of the curves
  int free_parameters = 0;
  int readings = 0;
};

// Errors: those of FitTwoJunctions.
Expected<PreparedTwoJunctions> PrepareTwoJunctions(const CurveSet& set,
                                                   const TwoJunctionOptions& options);

}  // namespace lyrefit
