#include "lyrefit/study/report/problem_verdict.h"

#include <fmt/format.h>

#include <cmath>

#include "lyrefit/report/text_layout.h"

namespace lyrefit {
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
