#include "lyrefit/diagnose/equivalents.h"

namespace lyrefit {

const Rival* OwnRival(const ChosenCause& cause) {
  for (const Rival& rival : cause.rivals) {
    if (rival.score.effect == cause.effect) return &rival;
  }
  return nullptr;
}

std::vector<const Rival*> EquivalentsOf(const ChosenCause& cause) {
  std::vector<const Rival*> equivalents;
  if (cause.in_values) return equivalents;
  const Rival* own = OwnRival(cause);
  const double least = (own != nullptr ? own->Charged() : 0) - kEquivalenceWidth;
  for (const Rival& rival : cause.rivals) {
    if (&rival != own && rival.Charged() >= least) equivalents.push_back(&rival);
  }
  return equivalents;
}

}  // namespace lyrefit
