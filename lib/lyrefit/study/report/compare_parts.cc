#include "lyrefit/study/report/compare_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

}  // namespace lyrefit
