#pragma once

#include <vector>

#include "lyrefit/certify/mixture.h"

namespace lyrefit {

// No model as good as the best known has a larger sum of leak and diode currents than `current_A` at
// the junction voltage `voltage_V`, for any Rs of a range.
struct DualGain {
  double current_A = kInfinity;
  double voltage_V = 0;  // positive
};

// For Rs in [rs0, rs1] and models whose half sum of squares is at most `known`: the difference of
// their currents at the points of the largest and the smallest junction voltage is known to within
// the residuals allowed. Infinite where these cannot be told apart.
template <class Real = double>
DualGain ComputeDualGain(const MixtureData& data, double rs0, double rs1, double known);

// A lower bound of half the sum of squares of every mixture over the windows with Rs between those
// of two solutions `a` and `b` (the lower one first, or twice the same) that is as good as the dual gain
// asks for. With `Real` Interval no rounding can raise it above the truth, if the solutions were
// made safe and no cause is among the terms. Between the two the interpolated dual vectors prove it:
// feasible up to second order in
// the distance, and what is lacking is priced.
struct PartBound {
  double lower = 0;  // may be negative, or -infinity
  double ends = 0;   // what the two ends alone prove, nothing priced
};
template <class Real = double>
PartBound BoundPart(const MixtureData& data, const std::vector<Window>& windows, const Mixture& a,
                    const Mixture& b, const DualGain& dual_gain, double known);

// What the dual vector of a mixture proves, evaluated anew in intervals: `dual` is rounded down,
// `pulls` and `excess` are rounded up, so that they hold without exception for the data as they
// are, and `relative_gap` says what is lost by it. `dual_gain_A` as for SolveMixture.
void MakeSafe(const MixtureData& data, const std::vector<Window>& windows, double dual_gain_A,
              Mixture* mixture);

}  // namespace lyrefit
