#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/family/family_report.h"
#include "lyrefit/report/plot/figure.h"

namespace lyrefit {

// The fit of `set`, coloured by cell temperature: measured points and model of up to twelve curves
// spread over the irradiances; over irradiance, the RMSE of each curve and its mean residual.
Figure FamilyFigure(const FamilyReport& report, const CurveSet& set);

// Draws it into `path`, a .svg or .png file. Errors as of DrawFigure.
Expected<void> PlotFamily(const FamilyReport& report, const CurveSet& set, const std::string& path,
                          PlotPoints points = PlotPoints::kThinned);

}  // namespace lyrefit
