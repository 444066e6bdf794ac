#pragma once

#include "lyrefit/refine/problem.h"

namespace lyrefit {

// Up to so many points are taken as they are.
constexpr int kFewPoints = 512;

// A problem of a few hundred points that stands for one of many: the points, in order of voltage,
// are cut into groups of neighbours, short where the curve bends, and each group becomes four
// points with its weight, its mean and its covariance of voltage and current or, for the solved
// current, the nodes of its Gauss quadrature, which keep what is a cubic within it. Sums of squares
// of anything that is straight within each group are kept, whatever the parameters, so the rise of
// the sum of squares around the optimum is kept to far better than the 1 % a profile is told to.
// Bounds, scales and kernel stay. A problem of at most kFewPoints comes back as it is, and one of a
// device with effects or of errors that hang together.
RefineProblem Coarsen(const RefineProblem& problem);

// Whether it would not come back as it is.
bool CanCoarsen(const RefineProblem& problem);

}  // namespace lyrefit
