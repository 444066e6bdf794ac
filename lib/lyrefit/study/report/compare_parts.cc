#include "lyrefit/study/report/compare_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "lyrefit/estimate/fit/usable.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

std::string Budget(const SearchOptions& search) {
  return fmt::format("{} candidates x {} iterations: {} evaluations at most", search.population,
                     search.iterations, PlannedEvaluations(search));
}

// The budget of all algorithms; empty if it differs between them.
std::string CommonBudget(const Comparison& comparison) {
  if (comparison.problems.empty()) return "";
  const auto& algorithms = comparison.problems[0].algorithms;
  const std::string budget = Budget(algorithms[0].search);
  const bool same = std::all_of(algorithms.begin(), algorithms.end(), [&](const auto& compared) {
    return Budget(compared.search) == budget;
  });
  return same ? budget : "";
}

bool AnyOwn(const Comparison& comparison) {
  if (comparison.problems.empty()) return false;
  const auto& algorithms = comparison.problems[0].algorithms;
  return std::any_of(algorithms.begin(), algorithms.end(),
                     [](const auto& compared) { return compared.own; });
}

// Of the runs and of the reference.
std::string SearchedInPart(double steepest_n) {
  return StepsLeftOut(steepest_n) + ". Runs and reference have n from there on";
}

}  // namespace

std::string ObjectiveText(const CompareOptions& options) {
  std::string text = ToText(options.objective);
  for (const EffectUse& use : options.with) text += ", with " + DescribeUse(use);
  return text;
}

std::string ProblemTitle(const ProblemResult& problem) {
  return fmt::format("{}, {} model, bounds {}", problem.curve_name, ModelTitle(problem.model),
                     problem.bounds_name);
}

std::string RunsText(const Comparison& comparison, const ProblemResult& problem) {
  if (problem.complete) return std::to_string(comparison.options.runs);
  std::size_t fewest = problem.algorithms[0].runs.size(), most = fewest;
  for (const AlgorithmResult& compared : problem.algorithms) {
    fewest = std::min(fewest, compared.runs.size());
    most = std::max(most, compared.runs.size());
  }
  const std::string done =
      fewest == most ? std::to_string(most) : fmt::format("{} to {}", fewest, most);
  return fmt::format("{} of {}", done, comparison.options.runs);
}

std::vector<std::string> CompareWarnings(const Comparison& comparison) {
  std::vector<std::string> warnings = comparison.doubts;
  for (const ProblemResult& problem : comparison.problems) {
    const double steepest_n = problem.reference.steepest_n;
    if (!(steepest_n > 0)) continue;
    warnings.push_back(fmt::format("{}: {}", ProblemTitle(problem), SearchedInPart(steepest_n)));
  }
  const std::vector<std::string>& over = comparison.over_budget;
  warnings.insert(warnings.end(), over.begin(), over.end());
  return warnings;
}

std::vector<std::string> CompareBanners(const Comparison& comparison) {
  std::vector<std::string> banners = Banners(false, true, "", comparison.doubts);
  for (const std::string& sentence : comparison.over_budget) {
    banners.push_back("UNEQUAL BUDGETS: " + sentence);
  }
  if (comparison.interrupted) {
    banners.push_back(
        "INTERRUPTED: only the runs that were done are counted; RMSEs and ranks are of those.");
  }
  return banners;
}

void AddSetUp(const Comparison& comparison, Section* section) {
  const CompareOptions& options = comparison.options;
  const bool one = std::all_of(comparison.problems.begin(), comparison.problems.end(),
                               [&](const ProblemResult& problem) {
                                 return problem.problem.empty() || !options.with.empty();
                               });
  const std::string of_what =
      one ? ObjectiveText(options) + ", in search, polish and every RMSE below"
          : "as each problem says, in search, polish and RMSE";
  AddField("objective", of_what + "; constants " + ToText(options.constants), section);
  const std::string budget = CommonBudget(comparison);
  if (!budget.empty()) AddField("budget", budget + " a run", section);
  const char* common = "";
  if (!budget.empty()) {
    common =
        AnyOwn(comparison)
            ? ": in each run lyrefit's searches start from the same points, which others may take"
            : ": in each run all searches start from the same points";
  }
  AddField("runs", fmt::format("0 to {} of seed {}{}", options.runs - 1, options.seed, common),
           section);
}

Section ProblemSection(const Comparison& comparison, const ProblemResult& problem) {
  const Reference& reference = problem.reference;
  const bool open = !reference.certified && std::isnan(reference.lower_bound_A);
  std::string text = fmt::format("{} A {}, {}{}", Scientific(reference.rmse_A, 10),
                                 ObjectiveText(comparison.options), reference.origin,
                                 open ? "; not proved to be the lowest" : "");
  if (!std::isnan(reference.floor_A)) {
    const double above = reference.rmse_A / reference.floor_A - 1;
    text += above <= kCertifiedGap
                ? "; no number of diodes goes lower"
                : fmt::format("; {} % above the floor of any number of diodes, {} A",
                              Significant(100 * above, 3), Scientific(reference.floor_A, 10));
  }
  Section section = {ProblemTitle(problem)};
  AddField("reference", text, &section);
  if (!problem.log_searched.empty()) {
    AddField("coordinates",
             fmt::format("the searches see ln({}) and the other parameters as they are",
                         fmt::join(problem.log_searched, "), ln(")),
             &section);
  }
  if (reference.steepest_n > 0) AddField("bounds", SearchedInPart(reference.steepest_n), &section);
  return section;
}

namespace {

constexpr double kSignificant = 0.05;

std::string PText(double p) { return p < 1e-300 ? "below 1e-300" : fmt::format("{:.2g}", p); }

using SignedRank = Ranking::SignedRank;

// For a significantly different pair: true if the first has the lower values.
bool FirstIsBetter(const SignedRank& pair) {
  return pair.test.rank_sum_plus < pair.test.rank_sum_minus;
}

// "mlo 1.20, de 1.80, ...", in increasing order of mean rank.
std::string MeanRanks(const std::vector<std::string>& names, const Friedman& friedman) {
  std::vector<int> order(friedman.mean_rank.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return friedman.mean_rank[a] < friedman.mean_rank[b]; });
  std::string text;
  for (const int c : order) {
    text += fmt::format("{}{} {:.2f}", text.empty() ? "" : ", ", names[c], friedman.mean_rank[c]);
  }
  const bool level = friedman.mean_rank[order.front()] == friedman.mean_rank[order.back()];
  if (level) text = fmt::format("all {:.2f}", friedman.mean_rank[0]);
  return text + fmt::format("; chi-square {:.4g} with {} degrees of freedom, p = {}",
                            friedman.chi_square, friedman.algorithms - 1, PText(friedman.p_value));
}

// A note on differences that are significant but only due to rounding: both algorithms always end
// at the reference.
std::string RoundingNote(const ProblemResult& problem, const Ranking& ranking) {
  const auto always_there = [&](int c) {
    const AlgorithmResult& compared = problem.algorithms[c];
    return compared.searched.within_1e9 == static_cast<int>(compared.runs.size());
  };
  const auto count = std::count_if(
      ranking.signed_ranks.begin(), ranking.signed_ranks.end(), [&](const SignedRank& pair) {
        return pair.p_holm < kSignificant && always_there(pair.first) && always_there(pair.second);
      });
  if (count == 0) return "";
  return fmt::format(
      "{} of these differences {} rounding: all runs of both are within 1e-9 of the reference",
      count, count == 1 ? "is" : "are");
}

// Number of differing runs over pairs of algorithms: "50", or "3 to 50" if pairs disagree.
struct Differing {
  int fewest = std::numeric_limits<int>::max();
  int most = 0;
  void Add(const SignedRank& pair) {
    fewest = std::min(fewest, pair.test.pairs);
    most = std::max(most, pair.test.pairs);
  }
  std::string Text() const {
    return fewest == most ? std::to_string(most) : fmt::format("{} to {}", fewest, most);
  }
};

std::string AtLeast(double p) { return p < 1 ? "p at least " + PText(p) : "p = 1"; }

// The pairs without a significant difference, and the number of their runs that differ at all.
std::vector<std::string> Undecided(const ProblemResult& problem, const Ranking& ranking) {
  const int runs = ranking.friedman.blocks;
  std::vector<std::string> sentences;
  Differing differing;
  double smallest_p = 1;
  bool all = true;
  for (int c = 0; c < static_cast<int>(problem.algorithms.size()); ++c) {
    std::string like;
    double smallest_here = 1;
    Differing here;
    for (const SignedRank& pair : ranking.signed_ranks) {
      if (pair.first != c) continue;
      all = all && pair.p_holm >= kSignificant;
      if (pair.p_holm < kSignificant) continue;
      like += (like.empty() ? "" : ", ") + problem.algorithms[pair.second].name;
      smallest_here = std::min(smallest_here, pair.p_holm);
      here.Add(pair);
      differing.Add(pair);
    }
    smallest_p = std::min(smallest_p, smallest_here);
    if (like.empty()) continue;
    sentences.push_back(
        fmt::format("{} not significantly different from {} ({}; {} of {} runs differ)",
                    problem.algorithms[c].name, like, AtLeast(smallest_here), here.Text(), runs));
  }
  if (!all) return sentences;
  if (differing.most == 0) return {"no pair differs: all runs of all algorithms are equal"};
  return {fmt::format("no pair differs significantly ({}; {} of {} runs differ)",
                      AtLeast(smallest_p), differing.Text(), runs)};
}

// A sentence for each algorithm that is significantly better than others. `names` are in the order of the ranks.
std::vector<std::string> WinnerSentences(const std::vector<std::string>& names,
                                         const Ranking& ranking) {
  std::vector<std::string> sentences;
  for (int c = 0; c < static_cast<int>(names.size()); ++c) {
    std::string losers;
    double largest_p = 0;
    for (const SignedRank& pair : ranking.signed_ranks) {
      const int winner = FirstIsBetter(pair) ? pair.first : pair.second;
      if (pair.p_holm >= kSignificant || winner != c) continue;
      const int loser = pair.first + pair.second - winner;
      losers += (losers.empty() ? "" : ", ") + names[loser];
      largest_p = std::max(largest_p, pair.p_holm);
    }
    if (losers.empty()) continue;
    sentences.push_back(
        fmt::format("{} below {} (p at most {})", names[c], losers, PText(largest_p)));
  }
  return sentences;
}

// Adds the mean ranks and the significant pairs of a stage. `note` is appended to the pairs.
void AddTests(const ProblemResult& problem, const Ranking& ranking, const char* stage,
              const std::string& note, Section* section) {
  if (ranking.friedman.algorithms == 0) return;
  const std::vector<std::string> names = AlgorithmNames(problem);
  const auto told_apart = [](const RankPair& pair) { return pair.p_sidak < kSignificant; };
  section->blocks.push_back(
      block::Entry{fmt::format("Ranks, {}: Friedman over {} runs", stage, ranking.friedman.blocks),
                   {MeanRanks(names, ranking.friedman)}});
  block::Entry pairs = {
      fmt::format("Pairs, {}: Wilcoxon signed-rank, Holm over {} pairs ({} differ by Dunn "
                  "and Sidak)",
                  stage, ranking.signed_ranks.size(),
                  std::count_if(ranking.pairs.begin(), ranking.pairs.end(), told_apart)),
      WinnerSentences(names, ranking)};
  if (!note.empty()) pairs.sentences.push_back(note);
  for (std::string& sentence : Undecided(problem, ranking)) {
    pairs.sentences.push_back(std::move(sentence));
  }
  section->blocks.push_back(std::move(pairs));
}

}  // namespace

Section RankSection(const ProblemResult& problem) {
  Section section = {"", {}, 1};
  AddTests(problem, problem.searched, "search alone", RoundingNote(problem, problem.searched),
           &section);
  AddTests(problem, problem.polished, "polished", "", &section);
  return section;
}

Section PolishVerdict(const ProblemResult& problem) {
  if (std::isnan(problem.algorithms[0].polished.min)) return {};
  std::size_t runs = 0, hits = 0;
  std::string missing;
  for (const AlgorithmResult& compared : problem.algorithms) {
    runs += compared.runs.size();
    hits += compared.polished.within_1e9;
    const std::size_t missed = compared.runs.size() - compared.polished.within_1e9;
    if (missed == 0) continue;
    missing += fmt::format("{}{} {}", missing.empty() ? "" : ", ", compared.name, missed);
  }
  const std::string where = fmt::format("{} of {} runs end within 1e-9 of {} A", hits, runs,
                                        Scientific(problem.reference.rmse_A, 10));
  if (missing.empty()) {
    const std::size_t count = problem.algorithms.size();
    const std::string who = count == 1   ? problem.algorithms[0].name + " always gets there"
                            : count == 2 ? std::string("both algorithms tie")
                                         : fmt::format("all {} algorithms tie", count);
    return {"", {block::Sentence{fmt::format("After the polish {}: {}.", who, where)}}, 1};
  }
  std::string text = fmt::format("After the polish {}; runs that do not: {}.", where, missing);
  const auto& pairs = problem.polished.signed_ranks;
  if (!pairs.empty()) {
    const auto differ = std::count_if(pairs.begin(), pairs.end(), [](const SignedRank& pair) {
      return pair.p_holm < kSignificant;
    });
    text += fmt::format(" Of the ranking {} of {} pairs are left.",
                        differ == 0 ? "none" : std::to_string(differ), pairs.size());
  }
  return {"", {block::Sentence{text}}, 1};
}

}  // namespace lyrefit
