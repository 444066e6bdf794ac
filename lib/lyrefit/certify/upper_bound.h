#pragma once

#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/certify/certify_options.h"
#include "lyrefit/certify/mixture.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/estimate/refine/problem.h"

namespace lyrefit {

// Parameters of a model with the mean of their squared residuals, an upper bound of the lowest
// possible mean square.
struct UpperBound {
  std::vector<double> p;  // in the device's order
  double mean_square = kInfinity;
};

// Ranges of a proof for one model. Iph, Is and Rsh without a range are only kept from being
// negative.
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
  std::vector<DiodeRanges> diodes = {};  // of each diode; empty: n as above, any Is
};

// Parameters of a model as a mixture; diodes without current are omitted. The `y` of the mixture
// has its residuals and proves no bound.
Mixture AsMixture(const Device& device, const MixtureData& data, const std::vector<double>& p);

// The unweighted least-squares problem of one model within the ranges.
RefineProblem ModelProblem(const IvCurve& curve, Device device, const ModelRanges& ranges,
                           Objective objective = Objective::kMeasuredCurrent);

// Refines the strongest diodes of a mixture, and a few starts that do not depend on it, to
// parameters of the model. A mixture that is itself a model within the ranges is also evaluated
// unchanged. Stores the lowest result in `best` if it is lower than `best`. Where the device would
// clip the exponent of a diode, Shockley's equation is evaluated without the clip.
void FindUpperBound(const RefineProblem& problem, const ModelRanges& ranges,
                    const MixtureData& data, const Mixture& mixture, UpperBound* best);

}  // namespace lyrefit
