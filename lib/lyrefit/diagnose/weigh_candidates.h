#pragma once

#include <vector>

#include "lyrefit/diagnose/effect_size.h"
#include "lyrefit/diagnose/fitted_candidate.h"

namespace lyrefit {

// What a fit leaves beyond what its law could still take up, root mean square in parts of Isc.
double MissedBy(const WeightedData& weighted, const LawFit& fit);

struct Weights {
  Floors floors;
  double level = 0.05;      // to which corrected p-values are compared
  double first_misfit = 0;  // mean square of what the first cause took away, in scales; 0: none yet
};

// Those of `all`, fits with one effect more than `fit`, that are certainly larger than the floors,
// explain their part of what there was to explain and are of a possible size; the likeliest first.
// `below` receives what is there all the same.
std::vector<FittedCandidate> WeighCandidates(const WeightedData& weighted, const LawFit& fit,
                               const std::vector<FittedCandidate>& all, const Weights& weights,
                               std::vector<FittedCandidate>* below);

}  // namespace lyrefit
