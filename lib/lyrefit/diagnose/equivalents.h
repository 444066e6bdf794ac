#pragma once

#include <vector>

#include "lyrefit/diagnose/select.h"

namespace lyrefit {

// Largest penalised difference in chi-square at which a candidate counts as equivalent to the best
// one.
constexpr double kEquivalenceWidth = 6;

// Fitted candidates that these data cannot separate from a cause, best first. Empty for a cause
// that shows in the values themselves.
std::vector<const FittedCandidate*> EquivalentsOf(const ChosenCause& cause);

// The cause's own entry among its fitted candidates; nullptr if absent.
const FittedCandidate* OwnFittedCandidate(const ChosenCause& cause);

}  // namespace lyrefit
