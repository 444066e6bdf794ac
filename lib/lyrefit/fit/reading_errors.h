#pragma once

#include <optional>
#include <vector>

#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/fit/error_spec.h"
#include "lyrefit/refine/active_set.h"
#include "lyrefit/refine/error_sizes.h"
#include "lyrefit/refine/problem.h"

namespace lyrefit {

// A curve's readings and its device at parameters `p`.
struct ReadingsAt {
  const Device& device;
  Objective objective;
  const std::vector<double>& voltage_V;
  const std::vector<double>& current_A;
  const std::vector<double>& weight;  // of the squared residuals
  double open_circuit_V;
  const std::vector<double>& p;
};

// A gain (FoundErrors) above this is believed: independent errors reach it in some 3 % of all
// curves.
constexpr double kGainToBelieve = 5;

// How errors of the readings show in the weighted residuals. The noise of a voltage has its size at
// Voc and is in proportion to the voltage elsewhere. The path goes along the readings as they were
// taken, in Voc. Effects beside the diodes change what light and voltages do too
// little to matter here.
void AppendErrorShape(const ReadingsAt& at, int chain, ErrorShape* shape);

// The same of one curve, with what its readings state.
ErrorShape ShapeOfErrors(const RefineProblem& problem, const IvCurve& curve,
                         const std::vector<double>& p);

// The sizes that the residuals at the end of a fit speak for; none where there are too few readings
// or nothing but rounding.
std::optional<FoundErrors> FindErrors(const RefineProblem& problem, const IvCurve& curve,
                                      const RefineEnd& end);

// The same problem weighed by errors of the sizes of `spec` about the parameters `p`; of a long
// curve without effects, on averages of neighbours. Stated sizes take the place of sigma_A, too.
RefineProblem WeighByErrors(const RefineProblem& plain, const IvCurve& curve, const ErrorSpec& spec,
                            const std::vector<double>& p);

}  // namespace lyrefit
