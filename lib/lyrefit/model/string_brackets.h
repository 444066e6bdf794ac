#pragma once

#include "lyrefit/model/string.h"

namespace lyrefit {

// Moves `state` near the root at `voltage` by nested bracketed searches over currents. It serves
// lanes in which Newton's steps cycle. The search is safe because two functions are monotone: the
// voltage of a string falls as its current rises, and the cell current of a substring rises with
// the string current.
void SolveByBrackets(const StringEffects& effects, const Cell<Pack>& cell,
                     const StringLimits& limits, const Pack& voltage, StringState* state);

}  // namespace lyrefit
