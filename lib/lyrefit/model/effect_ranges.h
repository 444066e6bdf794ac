#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/model/device_effects.h"

namespace lyrefit {

// Bounds of an effect's parameters in internal units, from requested ranges in reporting units.
// CheckParameter, CheckFitRanges and DescribeUse of device_effects.h are defined in
// effect_ranges.cc.

// Error with the effect's id in front: "weak_cell: why".
Error Unfit(const Effect& effect, const std::string& why);

// Appends the bounds and start values of one effect to `device_effects`, whose readings must be
// set. A requested range narrows the bounds; a whole-number parameter is restricted to whole
// numbers. Errors: a key that is no parameter, a reversed range, a range outside the effect's
// bounds, a range without a whole number.
Expected<void> AddUse(const EffectUse& use, DeviceEffects* device_effects);

}  // namespace lyrefit
