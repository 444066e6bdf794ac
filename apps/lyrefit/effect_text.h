#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"

namespace lyrefit {

// The full description of one effect of the catalogue. An unknown id is an error that lists the
// known ones.
Expected<std::string> ExplainEffect(const std::string& id);

// Ids of all effects: "shading, substrings, ...".
std::string EffectIds();

// All effects as a table.
std::string EffectList();

// Fails for ids that are not in the catalogue; the error names `flag`.
Expected<void> CheckEffects(const std::string& flag, const std::vector<std::string>& ids);

}  // namespace lyrefit
