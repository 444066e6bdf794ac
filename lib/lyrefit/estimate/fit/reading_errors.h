#pragma once

#include <optional>
#include <vector>

#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/estimate/fit/error_spec.h"
#include "lyrefit/estimate/refine/active_set.h"
#include "lyrefit/estimate/refine/error_sizes.h"
#include "lyrefit/estimate/refine/problem.h"

namespace lyrefit {

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
