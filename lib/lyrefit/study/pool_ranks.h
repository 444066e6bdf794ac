#pragma once

#include <string>
#include <vector>

#include "lyrefit/study/problem_summary.h"

namespace lyrefit {

// Ranks of the searches of one budget on one problem or on all: the blocks are all its runs of all
// devices, the figures RMSE / reference of the device. Figures of one block within kHit of each
// other are equal.
struct SummaryRanking {
  std::string problem;  // empty: all of them
  std::int64_t budget = 0;
  std::vector<std::string> names;  // of the algorithms, as the ranks count them
  Ranking searched;                // of the search alone
  Ranking own;                     // of the best candidate's own polish
};

// By rising budget: first of all problems together, where there are several, then of each in turn.
// Blocks that not every search of a budget has done are left out, and budgets with fewer than two
// searches or blocks.
std::vector<SummaryRanking> RankPools(const std::vector<ProblemSummary>& pools);

}  // namespace lyrefit
