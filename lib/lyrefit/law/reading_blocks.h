#pragma once

#include <vector>

#include "lyrefit/law/effect.h"
#include "lyrefit/law/reading.h"

namespace lyrefit {

// Readings in blocks: those under one sky in blocks of their own, where they fill half of one.
std::vector<ReadingBlock> BlocksOf(const Readings& readings);

}  // namespace lyrefit
