#include "lyrefit/diagnose/equivalents.h"

namespace lyrefit {

const FittedCandidate* OwnFittedCandidate(const ChosenCause& cause) {
  for (const FittedCandidate& fitted : cause.fitted_candidates) {
    if (fitted.score.effect == cause.effect) return &fitted;
  }
  return nullptr;
}

std::vector<const FittedCandidate*> EquivalentsOf(const ChosenCause& cause) {
  std::vector<const FittedCandidate*> equivalents;
  if (cause.in_values) return equivalents;
  const FittedCandidate* own = OwnFittedCandidate(cause);
  const double least = (own != nullptr ? own->Charged() : 0) - kEquivalenceWidth;
  for (const FittedCandidate& fitted : cause.fitted_candidates) {
    if (&fitted != own && fitted.Charged() >= least) equivalents.push_back(&fitted);
  }
  return equivalents;
}

}  // namespace lyrefit
