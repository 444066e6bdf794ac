#pragma once

#include <vector>

#include "lyrefit/diagnose/select.h"

namespace lyrefit {

// Causes whose fit is at most this much worse cannot be told from the best (in chi-square, after
// what each pays for its freedom).
constexpr double kEquivalenceWidth = 6;

// The fitted candidates that these data cannot tell from a cause, the best first; none where it shows in the
// values themselves.
std::vector<const FittedCandidate*> EquivalentsOf(const ChosenCause& cause);

// The cause's own among the fitted candidates; nullptr if it is not there.
const FittedCandidate* OwnFittedCandidate(const ChosenCause& cause);

}  // namespace lyrefit
