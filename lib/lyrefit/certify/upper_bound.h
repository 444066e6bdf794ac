#pragma once

#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/certify/certify_options.h"
#include "lyrefit/certify/mixture.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/refine/problem.h"

namespace lyrefit {

// Parameters of a model with the mean of their squared residuals: an upper bound
// of the lowest there is.
struct UpperBound {
  std::vector<double> p;  // in the device's order
  double mean_square = kInfinity;
};

// Ranges of a proof. Where Iph, Is and Rsh have none, they are only kept from being negative.
struct ModelRanges {
  double n_lower = 1;
  double n_upper = 2;
  double rs_lower = 0;
  double rs_upper = 0;
  double reference_voltage_V = 0;
  double iph_lower_A = 0;
  double iph_upper_A = kInfinity;
  double rsh_lower_ohm = 0;
  double rsh_upper_ohm = kInfinity;
  std::vector<DiodeRanges> diodes = {};  // of each; empty: n as above
};

// Parameters of a model as a mixture; diodes that carry nothing are left out. Its dual vector is that of
// the residuals, and proves nothing.
Mixture AsMixture(const Device& device, const MixtureData& data, const std::vector<double>& p);

// The model's own unweighted least-squares problem within the ranges.
RefineProblem ModelProblem(const IvCurve& curve, Device device, const ModelRanges& ranges,
                           Objective objective = Objective::kMeasuredCurrent);

// Polishes the strongest diodes of a mixture, and a few starts that owe nothing to it, and takes the
// mixture as it is where it is a model; keeps the better of `best` and what comes out. Where the
// device would cut the exponent of a diode, Shockley's equation is taken at its word.
void FindUpperBound(const RefineProblem& problem, const ModelRanges& ranges, const MixtureData& data,
            const Mixture& mixture, UpperBound* best);

}  // namespace lyrefit
