#pragma once

#include "lyrefit/certify/mixture.h"

namespace lyrefit {

// A lower bound of half the sum of squares of every mixture with a series resistance of `rs` or
// more. A model's current never rises with the junction voltage V + I Rs; where of two points the
// one of larger current also has the larger junction voltage, and it stays so for all larger Rs,
// the model has to miss them both. With `Real` Interval rounding cannot raise it above the truth.
template <class Real = double>
double BoundBeyond(const MixtureData& data, double rs);

// The same of the solved-current problem: there the current never rises with the terminal voltage,
// and falls by no more than the voltage rises over Rs.
double BoundBeyondSolved(const MixtureData& data, double rs);

}  // namespace lyrefit
