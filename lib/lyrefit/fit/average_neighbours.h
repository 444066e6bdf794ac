#pragma once

#include <functional>
#include <vector>

#include "lyrefit/base/dense.h"
#include "lyrefit/refine/error_sizes.h"
#include "lyrefit/refine/problem.h"

namespace lyrefit {

// Averages of neighbouring readings, for long sweeps with errors that neighbours share. If readings
// lie closer than the noise of their voltages, a smooth error path leaves only differences of
// neighbours to fit. The voltage differences are then mostly noise, and fitted slopes are too small
// (errors in variables). Averages lie further apart and are less noisy. A few hundred of them
// determine five parameters and a path as well as thousands of readings do.

// A grouping is a vector with the index of the first reading of each group, followed by the number
// of readings.

// Appends the first readings of the groups of the readings in [begin, end), of at most `most`
// readings each. `parted(first, k)` is true if reading k must not join the group that starts at
// `first`.
void AppendGroups(int begin, int end, int most, const std::function<bool(int, int)>& parted,
                  std::vector<int>* first);

// Groups of equally many readings, but with no voltage farther than 0.01 Voc from the first of its
// group. Up to kFewPoints readings are not grouped.
std::vector<int> GroupNeighbours(const std::vector<double>& voltage_V, double open_circuit_V);

// Grouping with one group per reading.
std::vector<int> EachAlone(std::size_t readings);

// Means of values, one per group; empty if `values` is empty.
std::vector<double> Means(const std::vector<int>& first, const std::vector<double>& values);

// Standard deviations of the group means for independent errors of standard deviation `errors`.
std::vector<double> MeanErrors(const std::vector<int>& first, const std::vector<double>& errors);

// Means of rows, one row per group.
RowMatrix AverageRows(const std::vector<int>& first, const RowMatrix& rows);

// Error shape of the group means. Independent errors are reduced. The path is kept except for the
// part that averages away within a group.
ErrorShape AverageShape(const std::vector<int>& first, const ErrorShape& shape);

// Differences of neighbours within the groups; each reading is in one difference at most.
Differences DifferencesWithin(const std::vector<int>& first, const ErrorShape& shape,
                              const Eigen::VectorXd& residual);

// The problem on mean voltages with equal weights. Each current is the model current at `p` plus
// the mean distance of the readings from the model, so that curvature is not averaged away. For
// solved currents of devices without effects.
RefineProblem AverageProblem(const std::vector<int>& first, const RefineProblem& problem,
                             const std::vector<double>& p);

}  // namespace lyrefit
