#pragma once

#include <vector>

#include "lyrefit/law/device.h"
#include "lyrefit/law/parameter.h"

namespace lyrefit {

// Puts what may change places without changing the curve in order, where the bounds are equal:
// diodes by rising n, vanished ones last; of effects the groups of cells (Effect::alike) by the
// first parameter of each, rising, absent ones last. `held` follows if it is not null. Where
// effects change what the cells stand under no two diodes are alike: the first follows the
// temperature otherwise than the others.
void OrderAlike(const Device& device, const std::vector<ParameterBounds>& bounds,
                std::vector<double>* p, std::vector<bool>* held);

}  // namespace lyrefit
