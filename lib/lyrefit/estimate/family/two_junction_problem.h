#pragma once

#include <map>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/estimate/family/two_junction_options.h"
#include "lyrefit/estimate/refine/two_junction_model.h"
#include "lyrefit/read/curve_set.h"

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
