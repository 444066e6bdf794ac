#pragma once

#include <string>

#include "lyrefit/fit/fit_report.h"

namespace lyrefit {

// Why nobody should work with this fit; empty where it can be used. A fit is of no use
//   - if its solved-current RMSE is not finite,
//   - if a straight line describes the readings as well: its AICc is no higher,
//   - if it was polished to its end and still misses the readings by more than 3 % of Isc. Diodes
//     miss healthy cells and modules by 0.05 to 0.3 %, noisy and drifting ones by up to some 2 %; a
//     conducting bypass diode, a limit of the instrument or what is no curve at all costs 5 % and
//     more. `robust` fits are judged by the median of their residuals instead.
std::string WhyNotUsable(const FitReport& report, bool interrupted, bool robust);

}  // namespace lyrefit
