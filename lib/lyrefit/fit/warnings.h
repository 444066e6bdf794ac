#pragma once

#include <string>
#include <vector>

#include "lyrefit/fit/fit_report.h"

namespace lyrefit {

// What a careful colleague would say on seeing this report, in plain words, most serious first.
std::vector<std::string> FindWarnings(const FitReport& report);

}  // namespace lyrefit
