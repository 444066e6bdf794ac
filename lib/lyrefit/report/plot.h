#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/fit/fit_report.h"
#include "lyrefit/report/plot/figure.h"

namespace lyrefit {

// The fit: above, current and power over voltage, measured points and the model; below, the
// residuals with a band of +- the solved-current RMSE.
Figure FitFigure(const FitReport& report);

// Draws it into `path`, a .svg or .png file. Errors as of DrawFigure.
Expected<void> PlotFit(const FitReport& report, const std::string& path,
                       PlotPoints points = PlotPoints::kThinned);

}  // namespace lyrefit
