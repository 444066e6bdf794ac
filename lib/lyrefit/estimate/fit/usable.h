#pragma once

#include <string>

#include "lyrefit/estimate/fit/fit_report.h"

namespace lyrefit {

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
