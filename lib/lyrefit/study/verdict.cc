#include "lyrefit/study/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "lyrefit/report/text_layout.h"

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

namespace {

std::string LevelPhrase(PolishLevel level) {
  switch (level) {
    case PolishLevel::kSearch:
      return "by itself";
    case PolishLevel::kPlain:
      return "with one plain solve";
    case PolishLevel::kOwn:
      return "with the best candidate's own polish";
    case PolishLevel::kHybrid:
      return "with all starts";
  }
  return "";
}

// "48 of 50"
std::string HitsText(const Configuration& way) {
  return fmt::format("{} of {}", way.figures().hits, way.figures().runs);
}

// "with the best candidate's own polish from 1000 evaluations (310 ms)"
std::string HowText(const Configuration& way, const char* from) {
  return fmt::format("{} {} {} evaluations ({})", LevelPhrase(way.level), from,
                     way.algorithm->budget, Duration(way.figures().seconds));
}

std::string ShapeText(const Configuration& shape) {
  return fmt::format("starts from the curve's shape alone hit {} ({})", HitsText(shape),
                     Duration(shape.figures().seconds));
}

std::string SearchText(const SearchVerdict& verdict) {
  if (verdict.search) {
    return fmt::format("of the searches {} reaches {} {}", verdict.search->algorithm->algorithm,
                       HitsText(*verdict.search), HowText(*verdict.search, "from"));
  }
  const int runs = verdict.best->figures().runs;
  if (verdict.best->figures().hits == 0) return "the searches never hit";
  return fmt::format("no search reaches {} of {} from any budget on; the best, {}, hits {} {}",
                     verdict.needed, runs, verdict.best->algorithm->algorithm,
                     verdict.best->figures().hits, HowText(*verdict.best, "at"));
}

std::string RandomText(const Configuration& random) {
  if (random.IsEnough()) {
    return fmt::format("random points reach {} {}", HitsText(random), HowText(random, "from"));
  }
  if (random.figures().hits == 0) return "random points hit in none";
  return fmt::format("random points do not: at most {}, {}", HitsText(random),
                     HowText(random, "at"));
}

std::string Headline(const SearchVerdict& verdict) {
  if (verdict.shape_wins) return "no search is needed";
  if (!verdict.search) return "nothing is enough";
  const std::string& name = verdict.search->algorithm->algorithm;
  return name == ToText(Algorithm::kRandom) ? "random points will do" : name + " will do";
}

}  // namespace

std::string VerdictText(const ProblemSummary& summary) {
  const SearchVerdict verdict = JudgeProblem(summary);
  std::string text = fmt::format("{}: {}", summary.name, Headline(verdict));
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

std::string PeerText(const ProblemSummary& summary) {
  const std::optional<PeerRatio> ratio = CompareWithPeers(summary);
  if (!ratio || !ratio->peer) return "";
  const auto brief = [](const Configuration& way) {
    return fmt::format("{} ({}, {})", way.algorithm->name, HitsText(way),
                       Duration(way.figures().seconds));
  };
  if (ratio->repeats == 0) return brief(ratio->self) + ": no peer ever hits";
  if (std::isnan(ratio->times)) {
    return fmt::format("{} never hits; {} does", brief(ratio->self), brief(*ratio->peer));
  }
  const std::string repeats =
      ratio->repeats == 1 ? "" : fmt::format(", run {} times", ratio->repeats);
  return fmt::format("{} is {:.3g} times {} than {}{}", brief(ratio->self),
                     ratio->times >= 1 ? ratio->times : 1 / ratio->times,
                     ratio->times >= 1 ? "faster" : "slower", brief(*ratio->peer), repeats);
}

}  // namespace lyrefit
