#pragma once

#include <vector>

#include "lyrefit/law/device.h"
#include "lyrefit/law/parameter.h"

namespace lyrefit {

// Puts interchangeable diodes (equal bounds) in order of rising n, vanished ones last. `held`
// follows if it is not null. Where effects change what the cells stand under no two diodes are:
// the first follows the temperature otherwise than the others.
void OrderDiodes(const Device& device, const std::vector<ParameterBounds>& bounds,
                 std::vector<double>* p, std::vector<bool>* held);

}  // namespace lyrefit
