#pragma once

#include <vector>

#include "lyrefit/model/device.h"
#include "lyrefit/model/parameter.h"

namespace lyrefit {

// Sorts interchangeable parameter sets with equal bounds, whose exchange leaves the curve
// unchanged. Diodes are sorted by rising n, absent ones last. Cell groups of effects
// (Effect::alike) are sorted by rising first parameter, absent ones last. `active` is permuted too
// if it is not null. Diodes are not interchangeable if effects change the operating conditions of
// cells, since the temperature dependence of the first diode then differs from that of the others.
void OrderAlike(const Device& device, const std::vector<ParameterBounds>& bounds,
                std::vector<double>* p, std::vector<bool>* active);

}  // namespace lyrefit
