#pragma once

#include <string>
#include <vector>

#include "lyrefit/refine/problem.h"

namespace lyrefit {

// The measured-current problem is linear in Iph, Is and 1/Rsh once Rs and the n are given. Both
// functions below live on that: only Rs and n move, the rest is solved exactly within its bounds. A
// device with effects is not linear in these: it has no such starts, and descends nowhere.

struct SeparableStart {
  std::string origin;  // "grid n = 1.14, 2; Rs = 0.036 ohm"
  std::vector<double> p;
  double mean_square = 0;  // of the problem's objective
};

// Starts that need no luck: a grid of Rs and of all combinations of n. The best `count` that differ
// in their n, judged by the problem's own objective. `rs_hint` adds a whole, half and a quarter of
// it to the grid of Rs (0: none).
std::vector<SeparableStart> SeparableStarts(const RefineProblem& problem, double rs_hint,
                                            int count);

// Descends from the Rs and n of `start` by a projected Levenberg-Marquardt method on the reduced
// problem (variable projection; Kaufman 1975, doi:10.1007/BF01932995), which follows the narrow
// local optima of sums of diodes in a few steps where the full problem needs hundreds. A diode whose
// current comes out 0 is moved to the n where the residuals ask for one, if there is such an n. For
// the solved-current objective the points are weighted by 1 / (1 - Rs F')^2, which makes both
// residuals agree to first order, so the end lies next to the optimum, not on it; on a curve that
// the model does not describe it may lie anywhere, see RefineFrom. `tolerance` is the relative
// decrease of the sum of squares by which a descent goes on.
std::vector<double> SeparableDescent(const RefineProblem& problem, const std::vector<double>& start,
                                     double tolerance = 1e-11);

}  // namespace lyrefit
