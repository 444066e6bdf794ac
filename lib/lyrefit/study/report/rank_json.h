#pragma once

#include <string>
#include <vector>

#include "lyrefit/report/json_parts.h"
#include "lyrefit/study/comparison.h"

namespace lyrefit {

// Friedman's test and every pair of the algorithms with these names. Null if there are no ranks.
Json RankingJson(const std::vector<std::string>& names, const Ranking& ranking);

}  // namespace lyrefit
