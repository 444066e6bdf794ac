#pragma once

#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// Whether the last effect of a fit draws what it stands for, and not what another cause draws: it
// stays off the bounds that its parameters name and off what `Effect::imitates` rejects, and the cells
// without it give no more voltage than their technology can (DataTraits::most_open_circuit). Of an effect
// of the sweep or of the instrument also these: what changes from one reading to the next jumps
// there in the readings, no moment of light lies where a sweep from deep reverse passes 0 V, and none
// after which the light stays at another level lies in the knee or at a step of bypass diodes.
bool IsItself(const WeightedData& weighted, const LawFit& fit);

}  // namespace lyrefit
