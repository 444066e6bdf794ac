#pragma once

#include <vector>

#include "lyrefit/model/effect.h"
#include "lyrefit/model/reading.h"

namespace lyrefit {

// Readings in blocks of eight. Readings at the same irradiance and temperature form their own block
// if they fill at least half of one.
std::vector<ReadingBlock> BlocksOf(const Readings& readings);

}  // namespace lyrefit
