#pragma once

#include <vector>

#include "lyrefit/base/groups.h"
#include "lyrefit/estimate/refine/error_sizes.h"
#include "lyrefit/estimate/refine/problem.h"

namespace lyrefit {

// Averages of neighbouring readings, for long sweeps with errors that neighbours share. If readings
// lie closer than the noise of their voltages, a smooth error path leaves only differences of
// neighbours to fit. The voltage differences are then mostly noise, and fitted slopes are too small
// (errors in variables). Averages lie further apart and are less noisy. A few hundred of them
// determine five parameters and a path as well as thousands of readings do.

// Groups of equally many readings, but with no voltage farther than 0.01 Voc from the first of its
// group. Up to kFewPoints readings are not grouped.
Grouping GroupNeighbours(const std::vector<double>& voltage_V, double open_circuit_V);

// Error shape of the group means. Independent errors are reduced. The path is kept except for the
// part that averages away within a group.
ErrorShape AverageShape(const Grouping& first, const ErrorShape& shape);

// Differences of neighbours within the groups; each reading is in one difference at most.
Differences DifferencesWithin(const Grouping& first, const ErrorShape& shape,
                              const Eigen::VectorXd& residual);

// The problem on mean voltages with equal weights. Each current is the model current at `p` plus
// the mean distance of the readings from the model, so that curvature is not averaged away. For
// solved currents of devices without effects.
RefineProblem AverageProblem(const Grouping& first, const RefineProblem& problem,
                             const std::vector<double>& p);

}  // namespace lyrefit
