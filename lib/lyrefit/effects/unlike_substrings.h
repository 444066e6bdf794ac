#pragma once

#include <array>
#include <vector>

#include "lyrefit/model/curve_shape.h"
#include "lyrefit/model/reading.h"

namespace lyrefit {

// Shares of the cells in three substrings, the brightest first.
using ThreeShares = std::array<double, 3>;

// Modules of three substrings whose middle one has half of all cells (24, 48 and 24): the orders of
// brightness that explain the steps of a curve better than three equal substrings do, or less well
// by `nearly` at most, in parts of the voltage. Empty for other data.
std::vector<ThreeShares> UnlikeShares(const CurveShape& shape, const DataTraits& traits,
                                      double nearly = 0);

// A step is placed no better than this.
inline constexpr double kStepPlaced = 0.03;

}  // namespace lyrefit
