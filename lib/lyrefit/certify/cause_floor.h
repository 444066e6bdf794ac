#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"

namespace LYREFIT_PUBLIC lyrefit {

// Options of ProveCauses(): the causes that are added to one diode, and the ranges of the
// parameters.
struct CauseFloorOptions {
  // Names: "second_diode" (a diode with n = 2), "collection" and "nonohmic_shunt".
  std::vector<std::string> causes = {"second_diode", "nonohmic_shunt", "collection"};
  double n_lower = 0.5;         // of the diode, per cell
  double n_upper = 4;           // upper end of that range
  double exponent_lower = 1.3;  // exponent of a non-ohmic shunt
  double exponent_upper = 5;    // upper end of that range
  bool recombination = false;   // true: every model also has a diode with n = 2
  ConstantSet constants = ConstantSet::kCodata;
  // A proof ends when the sum of squares reached exceeds the proved one by at most the larger of
  // two gaps. `relative_gap` is a fraction of the sum reached, `absolute_gap` a fraction of the sum
  // reached without a cause.
  double relative_gap = 0.02;
  double absolute_gap = 0.005;
  std::int64_t effort = 4000;  // convex problems solved for one cause before giving up
  StopToken stop = {};         // polled during the search
};

// Result for one cause. No model of one diode, a shunt, a series resistance and the cause has an
// unweighted measured-current RMSE below `lower_bound_A`, with all strengths and parameters free.
// For a cause with a parameter of its own, the bound also holds for mixtures over the whole range
// of that parameter.
struct ProvedCause {
  std::string cause;            // the requested name; empty: no cause
  double rmse_A = 0;            // reached, with one value of the cause's own parameter
  double lower_bound_A = 0;     // proved lower bound of the RMSE
  double parameter = kUnknown;  // that value: the exponent of a non-ohmic shunt
  std::int64_t solved = 0;      // convex problems solved
  bool complete = false;        // false: search ended early; the bound is still valid
};

// Floors of the unweighted measured-current RMSE of one curve, without a cause and with each cause.
struct CauseFloors {
  ProvedCause without;              // one diode without a cause
  std::vector<ProvedCause> causes;  // in the order requested
  double rs_upper_ohm = 0;          // end of the search; the order of the points bounds larger Rs
};

// Proves lower bounds of the measured-current RMSE of a curve for a single diode with one more
// cause whose current is linear in its strength. Errors: an unusable curve, no point that delivers
// current at a forward voltage, an unknown cause, bounds in the wrong order. Further errors are
// exponents of a non-ohmic shunt that do not start above 1, and so few cells in series that every
// diode's exponent exceeds kLargestExponent of model/term.h.
Expected<CauseFloors> ProveCauses(const IvCurve& curve, const CauseFloorOptions& options = {});

}  // namespace lyrefit
