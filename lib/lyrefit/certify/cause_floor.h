#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"

namespace LYREFIT_PUBLIC lyrefit {

// Which floors of one diode with a cause beside it are asked for, and within which bounds.
struct CauseFloorOptions {
  // Of "second_diode" (a diode with n = 2), "collection" and "nonohmic_shunt".
  std::vector<std::string> causes = {"second_diode", "nonohmic_shunt", "collection"};
  double n_lower = 0.5;         // of the diode, per cell
  double n_upper = 4;           // the same
  double exponent_lower = 1.3;  // of a non-ohmic shunt
  double exponent_upper = 5;    // the same
  bool recombination = false;   // a diode with n = 2 stands beside the first from the start
  ConstantSet constants = ConstantSet::kCodata;
  // A proof ends where the sum of squares that is attained lies within the larger of these above
  // the proved one: parts of itself, parts of that without a cause.
  double relative_gap = 0.02;
  double absolute_gap = 0.005;
  std::int64_t effort = 4000;       // convex problems solved for one cause before giving up
  std::function<bool()> stop = {};  // asked now and then, true ends the work; may be empty
};

// No model of one diode, a shunt, a series resistance and the cause, all strengths and parameters
// free, leaves a measured-current RMSE below `lower_bound_A`. Of causes with a parameter of their own
// this holds for mixtures over its whole range as well.
struct ProvedCause {
  std::string cause;            // as it was asked for; empty: none
  double rmse_A = 0;            // attained, by one value of the cause's own parameter
  double lower_bound_A = 0;     // proved
  double parameter = kUnknown;  // that value; of the exponent
  std::int64_t solved = 0;      // convex problems
  bool complete = false;        // false: given up early, the bound holds all the same
};

// What causes can explain of a curve's misfit, all of the measured-current objective, unweighted.
struct CauseFloors {
  ProvedCause without;              // the diode alone
  std::vector<ProvedCause> causes;  // as they were asked for
  double rs_upper_ohm = 0;  // larger series resistances are shut out by the order of the points
};

// Proves how low the measured-current RMSE of a curve can go with a single diode and one more cause
// whose current is linear in its strength. Errors: an unusable curve, no point that delivers current
// at a forward voltage, an unknown cause, bounds in the wrong order.
Expected<CauseFloors> ProveCauses(const IvCurve& curve, const CauseFloorOptions& options = {});

}  // namespace lyrefit
