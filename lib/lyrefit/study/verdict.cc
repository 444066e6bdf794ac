#include "lyrefit/study/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace lyrefit {
namespace {

constexpr char kPeers[] = "pagmo:";

std::string TimeText(double seconds) {
  if (!(seconds >= 0)) return "-";
  if (seconds < 0.9995) return fmt::format("{:.3g} ms", 1e3 * seconds);
  return fmt::format("{:.3g} s", seconds);
}

std::string LevelPhrase(PolishLevel level) {
  switch (level) {
    case PolishLevel::kSearch:
      return "by itself";
    case PolishLevel::kPlain:
      return "with one plain solve";
    case PolishLevel::kOwn:
      return "with its best bird's own polish";
    case PolishLevel::kHybrid:
      return "with all starts";
  }
  return "";
}

// "48 of 50"
std::string HitsText(const Way& way) {
  return fmt::format("{} of {}", way.figures().hits, way.figures().runs);
}

// "with its best bird's own polish from 1000 evaluations (310 ms)"
std::string HowText(const Way& way, const char* from) {
  return fmt::format("{} {} {} evaluations ({})", LevelPhrase(way.level), from,
                     way.contender->budget, TimeText(way.figures().seconds));
}

bool IsEnough(const Way& way) {
  return way.figures().hits >= EnoughHits(way.figures().runs);
}

// The way with the smallest budget of one algorithm at one level from which on all are enough.
std::optional<Way> EnoughFrom(std::vector<const PooledContender*> contenders, PolishLevel level) {
  std::sort(contenders.begin(), contenders.end(),
            [](const auto* a, const auto* b) { return a->budget > b->budget; });
  std::optional<Way> from;
  for (const PooledContender* contender : contenders) {
    if (!contender->At(level) || !IsEnough({contender, level})) break;
    from = Way{contender, level};
  }
  return from;
}

bool Faster(const Way& a, const Way& b) { return a.figures().seconds < b.figures().seconds; }

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

std::string ShapeText(const Way& shape) {
  return fmt::format("starts from the curve's shape alone hit {} ({})", HitsText(shape),
                     TimeText(shape.figures().seconds));
}

std::string SearchText(const Verdict& verdict) {
  if (verdict.search) {
    return fmt::format("of the searches {} reaches {} {}", verdict.search->contender->algorithm,
                       HitsText(*verdict.search), HowText(*verdict.search, "from"));
  }
  const int runs = verdict.best->figures().runs;
  return fmt::format("no search reaches {} of {} at any level; the best, {}, hits {} {}",
                     verdict.needed, runs,
                     verdict.best->contender->algorithm, verdict.best->figures().hits,
                     HowText(*verdict.best, "at"));
}

std::string RandomText(const Way& random) {
  if (IsEnough(random)) {
    return fmt::format("random points reach {} {}", HitsText(random), HowText(random, "from"));
  }
  return fmt::format("random points do not: at most {}, {}", HitsText(random),
                     HowText(random, "at"));
}

std::string Headline(const Verdict& verdict) {
  const bool quicker = verdict.shape_is_enough &&
                       (!verdict.search || !Faster(*verdict.search, *verdict.shape));
  if (quicker) return "no search is needed";
  if (!verdict.search) return "nothing is enough";
  const std::string& name = verdict.search->contender->algorithm;
  return name == ToText(Algorithm::kRandom) ? "random points will do" : name + " will do";
}

}  // namespace

int EnoughHits(int runs) { return static_cast<int>(std::ceil(kEnoughShare * runs - 1e-9)); }

Verdict JudgePool(const PooledProblem& pool) {
  Verdict verdict;
  verdict.shape = OfKind(pool, ContenderKind::kShape);
  verdict.shape_is_enough = verdict.shape && IsEnough(*verdict.shape);
  std::map<std::string, std::vector<const PooledContender*>> searches;
  for (const PooledContender& contender : pool.contenders) {
    if (contender.kind == ContenderKind::kSearch) searches[contender.algorithm].push_back(&contender);
  }
  verdict.has_searches = !searches.empty();
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
  if (verdict.search) verdict.best.reset();
  const std::optional<Way>& winner = verdict.search ? verdict.search : verdict.best;
  verdict.random = random_enough ? random_enough : random_best;
  const bool wins = winner && winner->contender->algorithm == ToText(Algorithm::kRandom);
  if (wins) verdict.random.reset();
  return verdict;
}

std::string VerdictText(const PooledProblem& pool) {
  const Verdict verdict = JudgePool(pool);
  std::string text = fmt::format("{}: {}", pool.name, Headline(verdict));
  const char* separator = ": ";
  const auto add = [&](const std::string& part) {
    text += separator + part;
    separator = "; ";
  };
  if (verdict.shape) add(ShapeText(*verdict.shape));
  if (verdict.search || verdict.best) add(SearchText(verdict));
  if (verdict.random) add(RandomText(*verdict.random));
  return text;
}

std::optional<PeerRatio> CompareWithPeers(const PooledProblem& pool) {
  const std::optional<Way> self = OfKind(pool, ContenderKind::kDefault);
  if (!self) return {};
  PeerRatio ratio{*self, {}, false, kUnknown};
  std::optional<Way> fastest, best;
  for (const PooledContender& contender : pool.contenders) {
    if (contender.algorithm.rfind(kPeers, 0) != 0 || !contender.At(PolishLevel::kOwn)) continue;
    const Way peer{&contender, PolishLevel::kOwn};
    Keep(peer, MoreHits, &best);
    if (peer.figures().hits >= self->figures().hits) Keep(peer, Faster, &fastest);
  }
  ratio.equal = fastest.has_value();
  ratio.peer = ratio.equal ? fastest : best;
  if (ratio.equal) ratio.times = fastest->figures().seconds / self->figures().seconds;
  return ratio;
}

std::string PeerText(const PooledProblem& pool) {
  const std::optional<PeerRatio> ratio = CompareWithPeers(pool);
  if (!ratio || !ratio->peer) return "";
  const auto brief = [](const Way& way) {
    return fmt::format("{} ({}, {})", way.contender->name, HitsText(way),
                       TimeText(way.figures().seconds));
  };
  if (!ratio->equal) {
    return fmt::format("{}: no peer hits as often; the best is {}", brief(ratio->self),
                       brief(*ratio->peer));
  }
  return fmt::format("{} is {:.3g} times {} than {}", brief(ratio->self),
                     ratio->times >= 1 ? ratio->times : 1 / ratio->times,
                     ratio->times >= 1 ? "faster" : "slower", brief(*ratio->peer));
}

}  // namespace lyrefit
