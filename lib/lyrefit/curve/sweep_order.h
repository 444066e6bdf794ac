#pragma once

#include <string>
#include <vector>

#include "lyrefit/curve/curve_set.h"

namespace lyrefit {

// A copy of the set in which curves whose readings come in no order (hardly two in a row go one
// way) are sorted by voltage, their times forgotten; says so.
CurveSet InOrder(const CurveSet& set, std::vector<std::string>* warnings);

// Where monotone stretches of voltage begin: 0, then every turning point. Turns of less than a
// fifth of the whole range are jitter.
std::vector<int> FindTurns(const std::vector<double>& voltage);

}  // namespace lyrefit
