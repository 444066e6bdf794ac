#pragma once

#include <vector>

#include "lyrefit/diagnose/select.h"

namespace lyrefit {

// Causes whose fit is at most this much worse cannot be told from the best (in chi-square, after
// what each pays for its freedom).
constexpr double kEquivalenceWidth = 6;

// The rivals that these data cannot tell from a cause, the best first; none where it shows in the
// values themselves.
std::vector<const Rival*> EquivalentsOf(const ChosenCause& cause);

// The cause's own among its rivals; nullptr if it is not there.
const Rival* OwnRival(const ChosenCause& cause);

}  // namespace lyrefit
