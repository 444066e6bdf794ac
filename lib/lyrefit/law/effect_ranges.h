#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/law/extension.h"

namespace lyrefit {

// From what was asked for of an effect's parameters to bounds in numbers of its own.
// CheckParameter, CheckFitRanges and DescribeUse of extension.h are defined beside it.

// "weak_cell: why"
Error Unfit(const Effect& effect, const std::string& why);

// Adds the bounds of one effect, narrower where that was asked for and between whole numbers where
// a parameter is one, and where a fit begins. `extension` has its readings. Errors: a key that is
// no parameter, a range that is reversed, outside the effect's own or without a whole number.
Expected<void> AddUse(const EffectUse& use, Extension* extension);

}  // namespace lyrefit
