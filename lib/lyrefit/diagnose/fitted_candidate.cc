#include "lyrefit/diagnose/fitted_candidate.h"

#include <algorithm>

namespace lyrefit {

void PutBestFirst(std::vector<FittedCandidate>* fitted_candidates) {
  std::stable_sort(
      fitted_candidates->begin(), fitted_candidates->end(),
      [](const FittedCandidate& a, const FittedCandidate& b) { return a.Charged() > b.Charged(); });
}

std::vector<const Effect*> RoomFor(const Law& law, const std::vector<const Effect*>& effects) {
  std::vector<const Effect*> open;
  for (const Effect* effect : effects) {
    if (CanAdd(law, *effect)) open.push_back(effect);
  }
  return open;
}

}  // namespace lyrefit
