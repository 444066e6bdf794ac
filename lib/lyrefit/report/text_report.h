#pragma once

#include <string>

#include "lyrefit/fit/fit_report.h"

namespace lyrefit {

// The whole report for a terminal of 100 columns. "-" stands for what is not known; '*' marks the
// objective that was fitted; every RMSE stands under its label. Ends with a newline.
std::string FullReport(const FitReport& report);

// One line: name, model, both RMSEs with their labels, parameters. Ends with a newline.
std::string BriefReport(const FitReport& report);

}  // namespace lyrefit
