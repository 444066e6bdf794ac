#pragma once

#include <functional>
#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/fit/fit_report.h"

namespace lyrefit {

// Draws the fit with gnuplot into `path`, a .svg or .png file: above, current and power over
// voltage, measured points and the model; below, the residuals with a band of +- the solved-current
// RMSE. Written completely or not at all. Errors: another extension, gnuplot missing, `path` not
// writable.
Expected<void> PlotFit(const FitReport& report, const std::string& path);

// Draws what `script` makes for a terminal, "svg" or "png" as the extension of `path` says. Errors
// as of PlotFit.
Expected<void> DrawScript(const std::function<std::string(const std::string& terminal)>& script,
                          const std::string& path);

// Whether PlotFit can draw into a file of this name: extension and gnuplot. To be asked before a
// long fit.
Expected<void> CheckPlot(const std::string& path);

}  // namespace lyrefit
