#pragma once

#include <string>
#include <vector>

#include "lyrefit/study/problem_summary.h"

namespace lyrefit {

// Ranks of the searches of one budget, on one problem or on all problems. The blocks are all runs
// of all devices. The ranked figure is RMSE / reference of the device. Figures of one block within
// kHit (relative) of each other are equal.
struct SummaryRanking {
  std::string problem;  // empty: all problems together
  std::int64_t budget = 0;
  std::vector<std::string> names;  // of the algorithms, in the order of the ranks
  Ranking searched;                // of the search alone
  Ranking own;                     // of the best candidate's own polish
};

// Rankings by increasing budget. For each budget the first ranks all problems together, if there
// are several, and then each problem follows. Blocks that not every search of a budget has done are
// left out. Budgets with fewer than two searches or blocks are left out.
std::vector<SummaryRanking> RankProblems(const std::vector<ProblemSummary>& summaries);

}  // namespace lyrefit
