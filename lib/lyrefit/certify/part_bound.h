#pragma once

#include <vector>

#include "lyrefit/certify/mixture.h"

namespace lyrefit {

// Upper bound of the dark current, which is the sum of shunt and diode currents, at one junction
// voltage for any Rs of a range. It holds for every model as good as the best known.
struct DarkCurrentBound {
  double current_A = kInfinity;
  double voltage_V = 0;  // positive
};

// The bound for Rs in [rs0, rs1] (ohm) and models whose half sum of squares is at most `known`. The
// currents of such models at the points of largest and smallest junction voltage are known to
// within the allowed residuals. Their difference gives the bound. It is infinite if the two
// junction voltages cannot be distinguished.
template <class Real = double>
DarkCurrentBound BoundDarkCurrent(const MixtureData& data, double rs0, double rs1, double known);

// Lower bound of half the sum of squares of every mixture over the windows with Rs between those of
// two solutions `a` and `b`, with a dark current within its bound. `a` has the lower Rs, or both are
// the same solution. The interpolated dual vectors prove the bound. They are feasible up to second
// order in the distance, and the infeasibility is subtracted as a penalty. With `Real` Interval
// rounding cannot raise the bound above the truth, if MakeSafe() was applied to both solutions.
struct PartBound {
  double lower = 0;  // may be negative, or -infinity
  double ends = 0;   // lower of the dual values at both ends, no penalty subtracted
};
template <class Real = double>
PartBound BoundPart(const MixtureData& data, const std::vector<Window>& windows, const Mixture& a,
                    const Mixture& b, const DarkCurrentBound& dark_bound, double known);

// Evaluates the proof of a mixture's dual vector again in intervals. `dual` is rounded down,
// `pulls` and `excess` are rounded up, so that they hold without exception for the given data.
// `relative_gap` includes what is lost by this rounding. `dark_bound_A` is that of SolveMixture().
void MakeSafe(const MixtureData& data, const std::vector<Window>& windows, double dark_bound_A,
              Mixture* mixture);

}  // namespace lyrefit
