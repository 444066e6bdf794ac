#include "lyrefit/study/pool_ranks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "lyrefit/study/summary.h"

namespace lyrefit {
namespace {

// The searches of a budget, in the order they came.
std::vector<std::string> SearchesOf(const std::vector<const PooledProblem*>& pools,
                                    std::int64_t budget) {
  std::vector<std::string> names;
  for (const PooledProblem* pool : pools) {
    for (const PooledContender& contender : pool->contenders) {
      if (contender.kind != ContenderKind::kSearch || contender.budget != budget) continue;
      if (std::find(names.begin(), names.end(), contender.algorithm) != names.end()) continue;
      names.push_back(contender.algorithm);
    }
  }
  return names;
}

// The figures of one device, run by run, of the runs that all have done.
void AddBlocks(const ProblemResult& device, const PooledRanking& ranking, PolishLevel level,
               std::vector<std::vector<double>>* values) {
  std::map<int, std::vector<double>> blocks;  // by run
  for (const std::string& name : ranking.names) {
    for (const ContenderResult& contender : device.contenders) {
      if (contender.algorithm != name || contender.budget != ranking.budget) continue;
      for (const RunRecord& run : contender.runs) {
        const double rmse = RmseAt(run, level);
        if (!std::isnan(rmse)) {
          blocks[run.run].push_back(std::min(rmse / device.reference.rmse_A, 1e300));
        }
      }
    }
  }
  for (auto& [run, block] : blocks) {
    if (block.size() != ranking.names.size()) continue;
    block = JoinEqual(std::move(block), kPoolHit);
    for (std::size_t c = 0; c < block.size(); ++c) (*values)[c].push_back(block[c]);
  }
}

Ranking RankLevel(const std::vector<const PooledProblem*>& pools, const PooledRanking& ranking,
                  PolishLevel level) {
  std::vector<std::vector<double>> values(ranking.names.size());
  for (const PooledProblem* pool : pools) {
    for (const ProblemResult* device : pool->devices) AddBlocks(*device, ranking, level, &values);
  }
  return RankAll(std::move(values));
}

void AddRankings(const std::vector<const PooledProblem*>& pools, const std::string& problem,
                 std::vector<PooledRanking>* rankings) {
  std::set<std::int64_t> budgets;
  for (const PooledProblem* pool : pools) {
    for (const PooledContender& contender : pool->contenders) {
      if (contender.budget > 0) budgets.insert(contender.budget);
    }
  }
  for (const std::int64_t budget : budgets) {
    PooledRanking ranking{problem, budget, SearchesOf(pools, budget), {}, {}};
    ranking.searched = RankLevel(pools, ranking, PolishLevel::kSearch);
    ranking.own = RankLevel(pools, ranking, PolishLevel::kOwn);
    if (ranking.searched.friedman.contenders > 0) rankings->push_back(std::move(ranking));
  }
}

}  // namespace

std::vector<PooledRanking> RankPools(const std::vector<PooledProblem>& pools) {
  std::vector<PooledRanking> rankings;
  std::vector<const PooledProblem*> all;
  all.reserve(pools.size());
  for (const PooledProblem& pool : pools) all.push_back(&pool);
  if (all.size() > 1) AddRankings(all, "", &rankings);
  for (const PooledProblem* pool : all) AddRankings({pool}, pool->name, &rankings);
  return rankings;
}

}  // namespace lyrefit
