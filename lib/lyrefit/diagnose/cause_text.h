#pragma once

#include <string>
#include <vector>

#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// Size of effect number `index` of a fit for a technician: in the effect's own words
// (Effect::in_words), else the largest change of the current. `strength`: its parameters as reported,
// whose intervals are repeated.
std::vector<std::string> InWords(const WeightedData& weighted, const LawFit& fit, int index,
                                 const std::vector<CauseParameter>& strength);

}  // namespace lyrefit
