#pragma once

#include <vector>

#include "lyrefit/diagnose/effect_size.h"
#include "lyrefit/diagnose/fitted_candidate.h"

namespace lyrefit {

// Lack of fit of a fit to its readings: root mean square in fractions of Isc, after projection off
// the law's parameters.
double MissedBy(const WeightedData& weighted, const LawFit& fit);

struct Weights {
  Floors floors;
  double level = 0.05;      // significance level for corrected p-values
  double first_misfit = 0;  // mean square of the first cause, squared scales; 0: no cause
};

// Selects among `all`, fits with one effect more than `fit`. Returned, preferred cause first: those
// with a possible size, certainly above a floor, that explain a sufficient fraction of the first
// cause's misfit. `below` receives the other significant ones.
std::vector<FittedCandidate> WeighCandidates(const WeightedData& weighted, const LawFit& fit,
                                             const std::vector<FittedCandidate>& all,
                                             const Weights& weights,
                                             std::vector<FittedCandidate>* below);

}  // namespace lyrefit
