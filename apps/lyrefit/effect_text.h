#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"

namespace lyrefit {

// Everything the catalogue says of one effect. An unknown id is an error that lists those there
// are.
Expected<std::string> ExplainEffect(const std::string& id);

// "shading, substrings, ...": their ids.
std::string EffectIds();

// All effects as a table.
std::string EffectList();

// Refuses ids that are not in the catalogue, in the name of `flag`.
Expected<void> CheckEffects(const std::string& flag, const std::vector<std::string>& ids);

}  // namespace lyrefit
