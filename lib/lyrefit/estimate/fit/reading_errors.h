#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "lyrefit/base/groups.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/estimate/fit/error_spec.h"
#include "lyrefit/estimate/refine/active_set.h"
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

// Standard errors of the estimates as a function of the error sizes.
using StandardErrorsAt = std::function<std::vector<double>(const ErrorSizes&)>;

// Degrees of freedom of each estimate's standard error, at most `most`. The error sizes were
// estimated from the same readings. Student's t accounts for that as if the squared standard error
// were a scaled chi-square of equal relative variance (Satterthwaite 1946, doi:10.2307/3002019).
std::vector<int> FindDegrees(const FoundErrors& found, const StandardErrorsAt& standard_errors,
                             int most);

// Readings of a curve and its device at parameters `p`.
struct ReadingsAt {
  const Device& device;
  Objective objective;
  const std::vector<double>& voltage_V;
  const std::vector<double>& current_A;
  const std::vector<double>& weight;  // of the squared residuals, one per reading
  double open_circuit_V;
  const std::vector<double>& p;
  bool dark = false;  // the curve has no photocurrent
};

// Appends the effect of reading errors on the weighted residuals. The noise of a voltage has its
// nominal size at Voc and is proportional to the voltage elsewhere. The path runs along the
// readings in the order of measurement, in units of Voc. Effects in addition to the diodes are
// neglected here, since their influence is small.
void AppendErrorShape(const ReadingsAt& at, int chain, ErrorShape* shape);

// Error shape of one curve, including the sigma_A of its readings.
ErrorShape ShapeOfErrors(const RefineProblem& problem, const IvCurve& curve,
                         const std::vector<double>& p);

// Error sizes estimated from the residuals at the end of a fit. None if there are too few readings
// or the residuals are only rounding. With `path_is_usual`, a lit curve has the usual path of
// modules unless the readings deny it; otherwise, and in the dark, it has to show one of its own.
std::optional<FoundErrors> FindErrors(const RefineProblem& problem, const IvCurve& curve,
                                      const RefineEnd& end, bool path_is_usual);

// The problem weighted by errors of the sizes of `spec` at parameters `p`. A long curve without
// effects is replaced by averages of neighbours. Stated sizes replace sigma_A, too.
RefineProblem WeighByErrors(const RefineProblem& plain, const IvCurve& curve, const ErrorSpec& spec,
                            const std::vector<double>& p);

}  // namespace lyrefit
