#pragma once

#include <limits>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// An unknown number: not stated, not computed or not identifiable.
inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace lyrefit
