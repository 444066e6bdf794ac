#pragma once

#include <vector>

#include "lyrefit/law/parameter.h"

namespace lyrefit {

// Puts interchangeable diodes (equal bounds) in order of rising n, vanished ones last. `held`
// follows if it is not null.
void OrderDiodes(const std::vector<ParameterBounds>& bounds, std::vector<double>* p,
                 std::vector<bool>* held);

}  // namespace lyrefit
