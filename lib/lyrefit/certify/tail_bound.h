#pragma once

#include "lyrefit/certify/mixture.h"

namespace lyrefit {

// Lower bound of half the sum of squares of every mixture with a series resistance of `rs` (ohm) or
// more. A model's current never rises with the junction voltage V + I Rs. Points of rising current
// that have rising junction voltages at `rs` have them at all larger Rs. A model then fits such a
// chain of points no better than their mean does. The bound is the sum over chains. With `Real`
// Interval rounding cannot raise it above the truth.
template <class Real = double>
double BoundTail(const MixtureData& data, double rs);

// Tail bound of the solved-current problem, from the single worst pair of points. The solved
// current never rises with the terminal voltage, and falls by no more than the voltage rises over
// Rs.
double BoundTailSolved(const MixtureData& data, double rs);

}  // namespace lyrefit
