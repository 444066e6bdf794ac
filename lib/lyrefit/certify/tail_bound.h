#pragma once

#include "lyrefit/certify/mixture.h"

namespace lyrefit {

// A lower bound of half the sum of squares of every mixture with a series resistance of `rs` or
// more. A model's current never rises with the junction voltage V + I Rs. Where points of rising
// current have rising junction voltages, which stays so for all larger Rs, the model can do no better
// than their mean; the points are sorted into such chains. With `Real` Interval rounding cannot raise
// the bound above the truth.
template <class Real = double>
double BoundTail(const MixtureData& data, double rs);

// The same of the solved-current problem: there the current never rises with the terminal voltage,
// and falls by no more than the voltage rises over Rs.
double BoundTailSolved(const MixtureData& data, double rs);

}  // namespace lyrefit
