#pragma once

#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/certify/mixture.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/refine/problem.h"

namespace lyrefit {

// Parameters of a model with the mean of their squared measured-current residuals: an upper bound
// of the lowest there is.
struct Attained {
  std::vector<double> p;  // in the device's order
  double mean_square = kInfinity;
};

// Ranges of a proof. Iph, Is and 1/Rsh are only kept from being negative.
struct ModelRanges {
  double n_lower = 1;
  double n_upper = 2;
  double rs_lower = 0;
  double rs_upper = 0;
  double reference_voltage_V = 0;
};

// The model's own unweighted least-squares problem within the ranges.
RefineProblem ModelProblem(const IvCurve& curve, Device device, const ModelRanges& ranges);

// Polishes the strongest diodes of a mixture, and a few starts that owe nothing to it; keeps the
// better of `best` and what comes out. Diodes so steep that the device cuts their exponent
// somewhere on the curve are passed over, for they are not what is proved.
void Attain(const RefineProblem& problem, const MixtureData& data, const Mixture& mixture,
            Attained* best);

}  // namespace lyrefit
