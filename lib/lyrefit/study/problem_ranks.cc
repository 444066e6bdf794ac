#include "lyrefit/study/problem_ranks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "lyrefit/study/summary.h"

namespace lyrefit {
namespace {

// The searches of a budget, in the order of the comparison.
std::vector<std::string> SearchesOf(const std::vector<const ProblemSummary*>& summaries,
                                    std::int64_t budget) {
  std::vector<std::string> names;
  for (const ProblemSummary* summary : summaries) {
    for (const AlgorithmSummary& compared : summary->algorithms) {
      if (compared.kind != AlgorithmKind::kSearch || compared.budget != budget) continue;
      if (std::find(names.begin(), names.end(), compared.algorithm) != names.end()) continue;
      names.push_back(compared.algorithm);
    }
  }
  return names;
}

// Appends the figures of one device, run by run, for the runs that all searches have done.
void AddBlocks(const ProblemResult& device, const SummaryRanking& ranking, PolishLevel level,
               std::vector<std::vector<double>>* values) {
  std::map<int, std::vector<double>> blocks;  // by run
  for (const std::string& name : ranking.names) {
    for (const AlgorithmResult& compared : device.algorithms) {
      if (compared.algorithm != name || compared.budget != ranking.budget) continue;
      for (const RunRecord& run : compared.runs) {
        const double rmse = RmseAt(run, level);
        if (!std::isnan(rmse)) {
          blocks[run.run].push_back(std::min(rmse / device.reference.rmse_A, 1e300));
        }
      }
    }
  }
  for (auto& [run, block] : blocks) {
    if (block.size() != ranking.names.size()) continue;
    block = JoinEqual(std::move(block), kHit);
    for (std::size_t c = 0; c < block.size(); ++c) (*values)[c].push_back(block[c]);
  }
}

Ranking RankLevel(const std::vector<const ProblemSummary*>& summaries,
                  const SummaryRanking& ranking, PolishLevel level) {
  std::vector<std::vector<double>> values(ranking.names.size());
  for (const ProblemSummary* summary : summaries) {
    for (const ProblemResult* device : summary->devices)
      AddBlocks(*device, ranking, level, &values);
  }
  return RankAll(std::move(values));
}

void AddRankings(const std::vector<const ProblemSummary*>& summaries, const std::string& problem,
                 std::vector<SummaryRanking>* rankings) {
  std::set<std::int64_t> budgets;
  for (const ProblemSummary* summary : summaries) {
    for (const AlgorithmSummary& compared : summary->algorithms) {
      if (compared.budget > 0) budgets.insert(compared.budget);
    }
  }
  for (const std::int64_t budget : budgets) {
    SummaryRanking ranking{problem, budget, SearchesOf(summaries, budget), {}, {}};
    ranking.searched = RankLevel(summaries, ranking, PolishLevel::kSearch);
    ranking.own = RankLevel(summaries, ranking, PolishLevel::kOwn);
    if (ranking.searched.friedman.algorithms > 0) rankings->push_back(std::move(ranking));
  }
}

}  // namespace

std::vector<SummaryRanking> RankProblems(const std::vector<ProblemSummary>& summaries) {
  std::vector<SummaryRanking> rankings;
  std::vector<const ProblemSummary*> all;
  all.reserve(summaries.size());
  for (const ProblemSummary& summary : summaries) all.push_back(&summary);
  if (all.size() > 1) AddRankings(all, "", &rankings);
  for (const ProblemSummary* summary : all) AddRankings({summary}, summary->name, &rankings);
  return rankings;
}

}  // namespace lyrefit
