#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/report/plot/figure.h"

namespace lyrefit {

// The diagnosis, coloured by curve, or by direction where one curve was swept both ways: measured
// points, base model and the model with its causes; below, what either leaves, in % of Isc. Where a
// cause acts most there is a band of its colour and its title stands beneath.
Figure DiagnosisFigure(const Diagnosis& diagnosis);

// Draws it into `path`, a .svg or .png file. Errors as of DrawFigure.
Expected<void> PlotDiagnosis(const Diagnosis& diagnosis, const std::string& path,
                             PlotPoints points = PlotPoints::kThinned);

}  // namespace lyrefit
