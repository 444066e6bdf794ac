#pragma once

#include "lyrefit/law/string.h"

namespace lyrefit {

// Moves the state near the root at `voltage` by current, with brackets: for lanes on which Newton's
// steps go round in circles. The voltage of a string falls as its current rises, and what a part's
// cells carry rises with what all carry.
void SolveByBrackets(const EvaluationContext<Pack>& context, const Cell<Pack>& cell, const StringLimits& limits,
                     const Pack& voltage, StringState* state);

}  // namespace lyrefit
