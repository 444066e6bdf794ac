#pragma once

#include <vector>

#include "lyrefit/read/column.h"
#include "lyrefit/read/label.h"

namespace lyrefit {

// Removes the words of direction, light and average, also those joined to a letter ("Vdark"), and
// returns what they state.
ColumnTag TakeTag(std::vector<LabelWord>* words);

}  // namespace lyrefit
