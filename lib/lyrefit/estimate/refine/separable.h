#pragma once

#include <string>
#include <vector>

#include "lyrefit/estimate/refine/problem.h"

namespace lyrefit {

// The measured-current problem is linear in Iph, Is and 1/Rsh at given Rs and n. Both functions
// below use that: only Rs and n move, and the linear unknowns are solved exactly within their
// bounds. A device with effects is not linear in these: it gets no starts, and its descent returns
// the start.

struct SeparableStart {
  std::string origin;  // "grid n = 1.14, 2; Rs = 0.036 ohm"
  std::vector<double> p;
  double mean_square = 0;  // of the problem's objective
};

// Deterministic starts: a grid of Rs and of all combinations of n. Returns the best `count` with
// different n, ranked by the problem's objective. `rs_hint` adds its whole, half and quarter to the
// grid of Rs (0: none).
std::vector<SeparableStart> SeparableStarts(const RefineProblem& problem, double rs_hint,
                                            int count);

// Descends from the Rs and n of `start` by a projected Levenberg-Marquardt method on the reduced
// problem (variable projection; Kaufman 1975, doi:10.1007/BF01932995). It follows the narrow local
// optima of sums of diodes in a few steps; the full problem needs hundreds. A diode with a current
// of 0 is moved to the n whose column correlates with the residuals, if there is one. For the
// solved-current objective the points are weighted by 1 / (1 - Rs F')^2, which makes both residuals
// agree to first order. The end then lies next to the optimum, not on it. On a curve that the model
// does not describe it may lie anywhere, see RefineFrom. `tolerance` is the least relative decrease
// of the sum of squares for a further step.
std::vector<double> SeparableDescent(const RefineProblem& problem, const std::vector<double>& start,
                                     double tolerance = 1e-11);

}  // namespace lyrefit
