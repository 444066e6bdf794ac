#pragma once

#include <vector>

#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// `count` of the given curves (positions in `conditions`), well spread over the logarithm of
// irradiance and over temperature: first the one nearest to 1000 W/m2 and 25 C, then each time the
// one farthest from all that were taken (doi:10.1016/0304-3975(85)90224-5). In rising order; all of
// them where there are no more.
std::vector<int> CurveSubset(const std::vector<Conditions>& conditions,
                              const std::vector<int>& among, int count);

}  // namespace lyrefit
