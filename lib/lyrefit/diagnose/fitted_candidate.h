#pragma once

#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/diagnose/candidate.h"
#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// An effect fitted in the company of others.
struct FittedCandidate {
  Score score;
  LawFit fit;
  double statistic = 0;    // what it takes off the sum of squares, in units of the noise variance
  double freedom = 0;      // what it pays for parameters beyond those of its probes
  double corrected_p = 1;  // of the statistic, the whole catalogue counted
  // What it leaves beyond what its law could still take up, root mean square in parts of Isc. NaN:
  // not asked.
  double left = kUnknown;
  double Charged() const { return statistic - score.charge - freedom; }
};

// By what they explain after what they pay; equals stay in their order.
void PutBestFirst(std::vector<FittedCandidate>* fitted_candidates);

// Those of `effects` that a law has room for.
std::vector<const Effect*> RoomFor(const Law& law, const std::vector<const Effect*>& effects);

}  // namespace lyrefit
