#pragma once

#include <string>

#include "lyrefit/fit/fit_report.h"

namespace lyrefit {

// gnuplot commands that draw the fit on standard output. `terminal` is "svg" or "png".
std::string PlotScript(const FitReport& report, const std::string& terminal);

}  // namespace lyrefit
