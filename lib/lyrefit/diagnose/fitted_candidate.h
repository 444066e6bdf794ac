#pragma once

#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/diagnose/candidate.h"
#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// An effect fitted together with the other effects of a law.
struct FittedCandidate {
  Score score;
  LawFit fit;
  double statistic = 0;    // reduction of the sum of squares, in units of the noise variance
  double freedom = 0;      // penalty for freed parameters beyond those of its probes
  double corrected_p = 1;  // of the statistic, corrected for the whole catalogue
  // Lack of fit of its law, root mean square in fractions of Isc. NaN: not computed.
  double left = kUnknown;
  double Charged() const { return statistic - score.charge - freedom; }
};

// Sorts by the penalised statistic (Charged), largest first. The sort is stable.
void PutBestFirst(std::vector<FittedCandidate>* fitted_candidates);

// The effects of `effects` that can be added to a law.
std::vector<const Effect*> RoomFor(const Law& law, const std::vector<const Effect*>& effects);

}  // namespace lyrefit
