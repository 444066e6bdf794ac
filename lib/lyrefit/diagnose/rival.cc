#include "lyrefit/diagnose/rival.h"

#include <algorithm>

namespace lyrefit {

void PutBestFirst(std::vector<Rival>* rivals) {
  std::stable_sort(rivals->begin(), rivals->end(),
                   [](const Rival& a, const Rival& b) { return a.Charged() > b.Charged(); });
}

std::vector<const Effect*> RoomFor(const Law& law, const std::vector<const Effect*>& effects) {
  std::vector<const Effect*> open;
  for (const Effect* effect : effects) {
    if (CanAdd(law, *effect)) open.push_back(effect);
  }
  return open;
}

}  // namespace lyrefit
