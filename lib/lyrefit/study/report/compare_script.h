#pragma once

#include "lyrefit/report/figure.h"
#include "lyrefit/study/comparison.h"

namespace lyrefit {

// Figures of a comparison, one panel for each problem; compare_plot.h describes them. At least one
// problem is required.
Figure BoxFigure(const Comparison& comparison);
Figure ConvergenceFigure(const Comparison& comparison);

}  // namespace lyrefit
