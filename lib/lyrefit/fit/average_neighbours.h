#pragma once

#include <functional>
#include <vector>

#include "lyrefit/base/dense.h"
#include "lyrefit/refine/error_sizes.h"
#include "lyrefit/refine/problem.h"

namespace lyrefit {

// A long sweep in averages of neighbouring readings, for errors that neighbours share. Where
// readings lie closer than their voltages are noisy, a path that is known to be smooth leaves
// differences of neighbours to fit, and what a voltage differs by is noise then: slopes come out
// too small (errors in variables). Averages lie further apart and are less noisy, and a few hundred
// hold what thousands of readings say of five parameters and a path.

// Groups of neighbours are stated by the first reading of each, and the end.

// Appends the first readings of the groups from reading `begin` to before `end`, of `most` readings
// or fewer. A group ends before a reading k that `parted(first, k)` keeps out of it.
void AppendGroups(int begin, int end, int most, const std::function<bool(int, int)>& parted,
                  std::vector<int>* first);

// Groups of equally many readings each, but none
// farther from its group's first than a hundredth of Voc. Up to kFewPoints readings stay alone.
std::vector<int> GroupNeighbours(const std::vector<double>& voltage_V, double open_circuit_V);

// Each reading by itself.
std::vector<int> EachAlone(std::size_t readings);

// Means of values, one for each group; empty where there are no values.
std::vector<double> Means(const std::vector<int>& first, const std::vector<double>& values);

// Errors of the means of independent errors, one for each group.
std::vector<double> MeanErrors(const std::vector<int>& first, const std::vector<double>& errors);

// Means of rows, one for each group.
RowMatrix AverageRows(const std::vector<int>& first, const RowMatrix& rows);

// How errors show in those means: of a reading by itself less, of the path as they are but for what
// averages away within a group.
ErrorShape AverageShape(const std::vector<int>& first, const ErrorShape& shape);

// Differences of neighbours within the groups, every reading in one at most.
Differences DifferencesWithin(const std::vector<int>& first, const ErrorShape& shape,
                              const Eigen::VectorXd& residual);

// The same problem, of equal weights, on mean voltages. A current is that of the model at `p` plus
// the mean distance of its readings from the model, so that bends are not averaged away. For solved
// currents of devices without effects.
RefineProblem AverageProblem(const std::vector<int>& first, const RefineProblem& problem,
                             const std::vector<double>& p);

}  // namespace lyrefit
