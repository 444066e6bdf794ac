#pragma once

#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/diagnose/diagnose_options.h"
#include "lyrefit/model/effect.h"

namespace lyrefit {

// The catalogue in the words of the setup, then the caller's own effects, in the order of reports.
// Errors: an own effect that cannot be fitted or whose id is already used; a requested id that does not
// exist.
Expected<std::vector<const Effect*>> KnownEffects(const DiagnoseOptions& options,
                                                  Setup setup = Setup::kUnknown);

// Whether an effect is among the requested ones (none requested: all).
bool IsWanted(const Effect& effect, const DiagnoseOptions& options);

// Why an effect is no candidate in these circumstances; null: it is one. Who asks for it by name, or
// states how common it is, gets it.
const char* WhyExcluded(const Effect& effect, const DiagnoseOptions& options);

// The effects of `known` that are found by scores and fits, in data with these traits.
std::vector<const Effect*> Candidates(const std::vector<const Effect*>& known,
                                      const DataTraits& traits, const DiagnoseOptions& options);

}  // namespace lyrefit
