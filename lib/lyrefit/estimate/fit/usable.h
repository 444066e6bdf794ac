#pragma once

#include <string>
#include <vector>

#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/model/device.h"

namespace lyrefit {

// Diodes so steep that the law cuts their exponents off (model/term.h). Such a diode is a step in the
// current, which could fit any data and is no diode. Searches and their references leave them out.

// Smallest n, per cell, at which no exponent is cut off at any reading, with Rs in its range.
double SteepestIdeality(const IvCurve& curve, const Device& device, const ParameterBounds& rs);

// Raises the lower bounds of n to that n where they begin below it. `bounds` and `fixed` (NaN: free)
// are in the order of the device; a fixed n keeps its bounds. Returns the raised bound; NaN: none
// was raised.
double LeaveOutSteps(const IvCurve& curve, const Device& device, const std::vector<double>& fixed,
                     std::vector<ParameterBounds>* bounds);

// Sentence on bounds that were raised to `steepest_n`, without its full stop.
std::string StepsLeftOut(double steepest_n);

struct UsabilityFacts {
  InformationCriteria criteria;  // of the fit
  double rmse_A = 0;             // solved-current, of all readings
  bool at_its_end = false;       // the fit was polished and not interrupted
  bool robust = false;           // the fit has a robust loss
  bool doubtful = false;         // there are doubts about the readings
};

// Largest misfit of a usable fit, in Isc.
inline constexpr double kLargestMisfit = 0.03;

// Reason why a fit is not usable; empty: it is. A fit is not usable
//   - if its solved-current RMSE is not finite,
//   - if the curve was logged at night: IsNight(),
//   - if a straight line describes the readings as well: by the F-test at 5 %,
//   - if it was polished to convergence and its misfit is above 3 % of Isc. The misfit of diode
//     models is 0.05 to 0.3 % for healthy cells and modules, up to some 2 % for noisy or drifting
//     ones. A conducting bypass diode, a limit of the instrument or readings that are no I-V curve
//     give 5 % and more. The misfit is the RMSE, or RobustScale() of the residuals if `robust`.
std::string WhyNotUsable(const IvCurve& curve, const ModelResults& results,
                         const UsabilityFacts& facts);

}  // namespace lyrefit
