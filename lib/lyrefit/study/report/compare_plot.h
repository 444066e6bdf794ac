// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/study/comparison.h"

namespace LYREFIT_PUBLIC lyrefit {

// Pictures of a comparison, drawn with gnuplot into a .svg, .png or .pdf file, one panel for each
// problem. A file is written completely or not at all. Errors: another extension, missing gnuplot,
// `path` not writable, nothing to draw. CheckPlot() of report/figure.h finds the first two
// beforehand.

// Box plot of the runs' distance above the reference, on a logarithmic scale. Each algorithm has a
// box for the search alone and one for the polish. Distances below 1e-10 (relative) are drawn at
// 1e-10.
Expected<void> PlotBoxes(const Comparison& comparison, const std::string& path);

// Median over the runs of the best value so far above the reference, against evaluations. Both axes
// are logarithmic.
Expected<void> PlotConvergence(const Comparison& comparison, const std::string& path);

}  // namespace lyrefit
