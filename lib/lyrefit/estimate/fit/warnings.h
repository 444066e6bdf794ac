#pragma once

#include <string>
#include <vector>

#include "lyrefit/estimate/fit/fit_report.h"

namespace lyrefit {

// Warnings about a report, as sentences, most serious first.
std::vector<std::string> FindWarnings(const FitReport& report);

}  // namespace lyrefit
