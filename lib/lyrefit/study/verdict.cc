#include "lyrefit/study/verdict.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace lyrefit {
namespace {

constexpr char kPeers[] = "pagmo:";

// The smallest budget of one algorithm at one level from which all budgets are sufficient.
std::optional<Configuration> EnoughFrom(std::vector<const AlgorithmSummary*> algorithms,
                                        PolishLevel level) {
  std::sort(algorithms.begin(), algorithms.end(),
            [](const auto* a, const auto* b) { return a->budget > b->budget; });
  std::optional<Configuration> from;
  for (const AlgorithmSummary* compared : algorithms) {
    if (!compared->At(level) || !Configuration{compared, level}.IsEnough()) break;
    from = Configuration{compared, level};
  }
  return from;
}

// An unknown time counts as the slowest.
bool Faster(const Configuration& a, const Configuration& b) {
  const double there = b.figures().seconds;
  return a.figures().seconds < there || (std::isnan(there) && !std::isnan(a.figures().seconds));
}

bool MoreHits(const Configuration& a, const Configuration& b) {
  if (a.figures().hits != b.figures().hits) return a.figures().hits > b.figures().hits;
  return Faster(a, b);
}

void Keep(const std::optional<Configuration>& way,
          bool (*better)(const Configuration&, const Configuration&),
          std::optional<Configuration>* best) {
  if (way && (!*best || better(*way, **best))) *best = way;
}

std::optional<Configuration> OfKind(const ProblemSummary& summary, AlgorithmKind kind) {
  for (const AlgorithmSummary& compared : summary.algorithms) {
    if (compared.kind != kind || !compared.At(PolishLevel::kHybrid)) continue;
    return Configuration{&compared, PolishLevel::kHybrid};
  }
  return {};
}

// Number of runs for one hit with probability kEnoughShare; 0: it never hits.
int RepeatsToBeSure(const Configuration& way) {
  const LevelSummary& figures = way.figures();
  if (figures.hits == 0) return 0;
  if (way.IsEnough()) return 1;
  const double misses = 1 - static_cast<double>(figures.hits) / figures.runs;
  return static_cast<int>(std::ceil(std::log(1 - kEnoughShare) / std::log(misses) - 1e-9));
}

bool SoonerSure(const Configuration& a, const Configuration& b) {
  const double here = TimeToBeSure(a), there = TimeToBeSure(b);
  return std::isinf(here) && std::isinf(there) ? Faster(a, b) : here < there;
}

}  // namespace

int EnoughHits(int runs) { return static_cast<int>(std::ceil(kEnoughShare * runs - 1e-9)); }

SearchVerdict JudgeProblem(const ProblemSummary& summary) {
  SearchVerdict verdict;
  verdict.shape = OfKind(summary, AlgorithmKind::kShape);
  verdict.shape_is_enough = verdict.shape && verdict.shape->IsEnough();
  std::map<std::string, std::vector<const AlgorithmSummary*>> searches;
  for (const AlgorithmSummary& compared : summary.algorithms) {
    if (compared.kind == AlgorithmKind::kSearch) searches[compared.algorithm].push_back(&compared);
  }
  std::optional<Configuration> random_enough, random_best;
  for (const auto& [name, algorithms] : searches) {
    const bool is_random = name == ToText(Algorithm::kRandom);
    for (const PolishLevel level : kPolishLevels) {
      if (level == PolishLevel::kHybrid && verdict.shape_is_enough) continue;
      const std::optional<Configuration> from = EnoughFrom(algorithms, level);
      Keep(from, Faster, &verdict.search);
      if (is_random) Keep(from, Faster, &random_enough);
      for (const AlgorithmSummary* compared : algorithms) {
        if (!compared->At(level)) continue;
        const Configuration way{compared, level};
        verdict.needed = EnoughHits(way.figures().runs);
        Keep(way, MoreHits, &verdict.best);
        if (is_random) Keep(way, MoreHits, &random_best);
      }
    }
  }
  verdict.shape_wins =
      verdict.shape_is_enough && (!verdict.search || !Faster(*verdict.search, *verdict.shape));
  if (verdict.search) verdict.best.reset();
  const std::optional<Configuration>& winner = verdict.search ? verdict.search : verdict.best;
  verdict.random = random_enough ? random_enough : random_best;
  const bool wins = winner && winner->algorithm->algorithm == ToText(Algorithm::kRandom);
  if (wins) verdict.random.reset();
  return verdict;
}

double TimeToBeSure(const Configuration& way) {
  const int repeats = RepeatsToBeSure(way);
  return repeats == 0 ? kInfinity : repeats * way.figures().seconds;
}

std::optional<PeerRatio> CompareWithPeers(const ProblemSummary& summary) {
  const std::optional<Configuration> self = OfKind(summary, AlgorithmKind::kDefault);
  if (!self) return {};
  PeerRatio ratio{*self, {}, 0, kUnknown};
  for (const AlgorithmSummary& compared : summary.algorithms) {
    if (compared.algorithm.rfind(kPeers, 0) != 0 || !compared.At(PolishLevel::kOwn)) continue;
    Keep(Configuration{&compared, PolishLevel::kOwn}, SoonerSure, &ratio.peer);
  }
  if (!ratio.peer) return ratio;
  ratio.repeats = RepeatsToBeSure(*ratio.peer);
  if (ratio.repeats > 0) ratio.times = TimeToBeSure(*ratio.peer) / TimeToBeSure(*self);
  return ratio;
}

}  // namespace lyrefit
