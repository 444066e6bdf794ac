#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/family/family_report.h"

namespace lyrefit {

// Draws the fit of `set` into `path`, a .svg or .png file, coloured by cell temperature: measured
// points and model of up to twelve curves spread over the irradiances; over irradiance, the RMSE of
// each curve and its mean residual. Errors as of PlotFit.
Expected<void> PlotFamily(const FamilyReport& report, const CurveSet& set, const std::string& path);

}  // namespace lyrefit
