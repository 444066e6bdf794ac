#pragma once

#include <vector>

#include "lyrefit/diagnose/select.h"

namespace lyrefit {

// The rivals that these data cannot tell from a cause, the best first; none where it shows in the
// values themselves.
std::vector<const Rival*> EquivalentsOf(const ChosenCause& cause);

// The cause's own among its rivals; nullptr if it is not there.
const Rival* OwnRival(const ChosenCause& cause);

}  // namespace lyrefit
