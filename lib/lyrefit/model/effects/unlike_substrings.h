#pragma once

#include <array>
#include <vector>

#include "lyrefit/model/curve_shape.h"
#include "lyrefit/model/reading.h"

namespace lyrefit {

// Shares of the cells in three substrings, the brightest first.
using ThreeShares = std::array<double, 3>;

// Modules of three substrings whose middle one has half of all cells (24, 48 and 24): the orders of
// brightness that explain the steps of a curve better than three equal substrings do. Empty for
// other data.
std::vector<ThreeShares> UnlikeShares(const CurveShape& shape, const DataTraits& traits);

}  // namespace lyrefit
