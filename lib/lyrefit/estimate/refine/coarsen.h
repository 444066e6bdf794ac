#pragma once

#include "lyrefit/estimate/refine/problem.h"

namespace lyrefit {

// Curves of at most this many points are not coarsened.
constexpr int kFewPoints = 512;

// A problem of a few hundred points that replaces one of many. The points, in order of voltage, are
// cut into groups of neighbours, short where the curve bends. Measured current: each group becomes
// four points with its weight, its mean and its covariance of voltage and current. Solved current:
// each group becomes the nodes of its Gauss quadrature, which keep a cubic within the group. Sums
// of squares of residuals that are straight within each group are kept for all parameters. The rise
// of the sum of squares around the optimum is therefore kept far better than the 0.3 % to which a
// profile finds its root. Bounds, scales and kernel stay. Returns the problem unchanged for at most
// kFewPoints, a device with effects, or correlated errors.
RefineProblem Coarsen(const RefineProblem& problem);

// The problem with other points and independent errors. Bounds, scales and kernel stay.
RefineProblem WithPoints(const RefineProblem& problem, std::vector<double> voltage_V,
                         std::vector<double> current_A, std::vector<double> weights);

// Whether Coarsen changes the problem.
bool CanCoarsen(const RefineProblem& problem);

}  // namespace lyrefit
