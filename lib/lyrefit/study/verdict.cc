#include "lyrefit/study/verdict.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace lyrefit {
namespace {

constexpr char kPeers[] = "pagmo:";

// The way with the smallest budget of one algorithm at one level from which on all are enough.
std::optional<Way> EnoughFrom(std::vector<const PooledContender*> contenders, PolishLevel level) {
  std::sort(contenders.begin(), contenders.end(),
            [](const auto* a, const auto* b) { return a->budget > b->budget; });
  std::optional<Way> from;
  for (const PooledContender* contender : contenders) {
    if (!contender->At(level) || !Way{contender, level}.IsEnough()) break;
    from = Way{contender, level};
  }
  return from;
}

// What was not timed counts as the slowest.
bool Faster(const Way& a, const Way& b) {
  const double there = b.figures().seconds;
  return a.figures().seconds < there || (std::isnan(there) && !std::isnan(a.figures().seconds));
}

bool MoreHits(const Way& a, const Way& b) {
  if (a.figures().hits != b.figures().hits) return a.figures().hits > b.figures().hits;
  return Faster(a, b);
}

void Keep(const std::optional<Way>& way, bool (*better)(const Way&, const Way&),
          std::optional<Way>* best) {
  if (way && (!*best || better(*way, **best))) *best = way;
}

std::optional<Way> OfKind(const PooledProblem& pool, ContenderKind kind) {
  for (const PooledContender& contender : pool.contenders) {
    if (contender.kind != kind || !contender.At(PolishLevel::kHybrid)) continue;
    return Way{&contender, PolishLevel::kHybrid};
  }
  return {};
}

// 0: it never hits.
int RepeatsToBeSure(const Way& way) {
  const PooledLevel& figures = way.figures();
  if (figures.hits == 0) return 0;
  if (way.IsEnough()) return 1;
  const double misses = 1 - static_cast<double>(figures.hits) / figures.runs;
  return static_cast<int>(std::ceil(std::log(1 - kEnoughShare) / std::log(misses) - 1e-9));
}

bool SoonerSure(const Way& a, const Way& b) {
  const double here = TimeToBeSure(a), there = TimeToBeSure(b);
  return std::isinf(here) && std::isinf(there) ? Faster(a, b) : here < there;
}

}  // namespace

int EnoughHits(int runs) { return static_cast<int>(std::ceil(kEnoughShare * runs - 1e-9)); }

SearchVerdict JudgePool(const PooledProblem& pool) {
  SearchVerdict verdict;
  verdict.shape = OfKind(pool, ContenderKind::kShape);
  verdict.shape_is_enough = verdict.shape && verdict.shape->IsEnough();
  std::map<std::string, std::vector<const PooledContender*>> searches;
  for (const PooledContender& contender : pool.contenders) {
    if (contender.kind == ContenderKind::kSearch)
      searches[contender.algorithm].push_back(&contender);
  }
  std::optional<Way> random_enough, random_best;
  for (const auto& [name, contenders] : searches) {
    const bool is_random = name == ToText(Algorithm::kRandom);
    for (const PolishLevel level : kPolishLevels) {
      if (level == PolishLevel::kHybrid && verdict.shape_is_enough) continue;
      const std::optional<Way> from = EnoughFrom(contenders, level);
      Keep(from, Faster, &verdict.search);
      if (is_random) Keep(from, Faster, &random_enough);
      for (const PooledContender* contender : contenders) {
        if (!contender->At(level)) continue;
        const Way way{contender, level};
        verdict.needed = EnoughHits(way.figures().runs);
        Keep(way, MoreHits, &verdict.best);
        if (is_random) Keep(way, MoreHits, &random_best);
      }
    }
  }
  verdict.shape_wins =
      verdict.shape_is_enough && (!verdict.search || !Faster(*verdict.search, *verdict.shape));
  if (verdict.search) verdict.best.reset();
  const std::optional<Way>& winner = verdict.search ? verdict.search : verdict.best;
  verdict.random = random_enough ? random_enough : random_best;
  const bool wins = winner && winner->contender->algorithm == ToText(Algorithm::kRandom);
  if (wins) verdict.random.reset();
  return verdict;
}

double TimeToBeSure(const Way& way) {
  const int repeats = RepeatsToBeSure(way);
  return repeats == 0 ? kInfinity : repeats * way.figures().seconds;
}

std::optional<PeerRatio> CompareWithPeers(const PooledProblem& pool) {
  const std::optional<Way> self = OfKind(pool, ContenderKind::kDefault);
  if (!self) return {};
  PeerRatio ratio{*self, {}, 0, kUnknown};
  for (const PooledContender& contender : pool.contenders) {
    if (contender.algorithm.rfind(kPeers, 0) != 0 || !contender.At(PolishLevel::kOwn)) continue;
    Keep(Way{&contender, PolishLevel::kOwn}, SoonerSure, &ratio.peer);
  }
  if (!ratio.peer) return ratio;
  ratio.repeats = RepeatsToBeSure(*ratio.peer);
  if (ratio.repeats > 0) ratio.times = TimeToBeSure(*ratio.peer) / TimeToBeSure(*self);
  return ratio;
}

}  // namespace lyrefit
