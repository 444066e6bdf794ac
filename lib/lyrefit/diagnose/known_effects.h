#pragma once

#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/diagnose/diagnose_options.h"
#include "lyrefit/law/effect.h"

namespace lyrefit {

// The catalogue and the caller's own effects, in the order of reports. Errors: an own effect that
// cannot be fitted or whose id is taken, an id asked for that nobody has.
Expected<std::vector<const Effect*>> KnownEffects(const DiagnoseOptions& options);

// Whether an effect is among those asked for.
bool IsWanted(const Effect& effect, const DiagnoseOptions& options);

// Those of the `known` that are looked for by scores and fits in data of this kind.
std::vector<const Effect*> Candidates(const std::vector<const Effect*>& known,
                                      const DataTraits& traits, const DiagnoseOptions& options);

}  // namespace lyrefit
