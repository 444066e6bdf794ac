#pragma once

#include <vector>

#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// Selects `count` of the curves `among` (positions in `conditions`), well spread over the logarithm
// of irradiance and over temperature. The first is nearest to 1000 W/m2 and 25 C; each further one
// is the farthest from all selected so far (doi:10.1016/0304-3975(85)90224-5). Returns positions in
// rising order, or all of `among` if it has no more than `count`.
std::vector<int> CurveSubset(const std::vector<Conditions>& conditions,
                             const std::vector<int>& among, int count);

}  // namespace lyrefit
