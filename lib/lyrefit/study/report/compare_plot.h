#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/study/comparison.h"

namespace LYREFIT_PUBLIC lyrefit {

// Pictures of a comparison, drawn with gnuplot into a .svg or .png file, one panel a problem.
// Written completely or not at all. Errors: another extension, gnuplot missing, `path` not
// writable, nothing to draw. CheckPlot() of report/figure.h finds the first two
// beforehand.

// How far the runs end above the reference, on a logarithmic scale: a box a compared for the
// search alone and one after the polish. What is closer than 1e-10 of the reference lies on the
// lowest line.
Expected<void> PlotBoxes(const Comparison& comparison, const std::string& path);

// Median over the runs of the best so far, above the reference, over evaluations; both logarithmic.
Expected<void> PlotConvergence(const Comparison& comparison, const std::string& path);

// Algorithms of BudgetAlgorithms(): share of runs that hit over evaluations, a row of panels a
// problem, a column a polish level.
Expected<void> PlotBudget(const Comparison& comparison, const std::string& path);

}  // namespace lyrefit
