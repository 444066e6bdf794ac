#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/diagnose/diagnosis.h"

namespace lyrefit {

// Draws the diagnosis into `path`, a .svg or .png file, coloured by curve, or by direction where
// one curve was swept both ways: measured points, base model and the model with its causes; below,
// what either leaves, in standard deviations of the noise. Where a cause acts most the points are
// marked in its colour and its title stands beside them. Errors as of PlotFit.
Expected<void> PlotDiagnosis(const Diagnosis& diagnosis, const std::string& path);

}  // namespace lyrefit
