// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/report/figure.h"

// Pictures of the records. One function makes the figure, which is data; another draws it into
// `path`, a .svg, .png or .pdf file, with the errors of DrawFigure.
namespace LYREFIT_PUBLIC lyrefit {

struct FitReport;

// A fit. Above: current and power over voltage, measured points and model. Below: residuals with a
// band of +- the solved-current RMSE.
Figure FitFigure(const FitReport& report);
Expected<void> PlotFit(const FitReport& report, const std::string& path,
                       PlotPoints points = PlotPoints::kThinned);

}  // namespace lyrefit
