#include "lyrefit/study/report/compare_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/certify/certify.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"
#include "lyrefit/study/report/compare_sections.h"

namespace lyrefit {
namespace {

constexpr std::size_t kLongName = 18;  // from here on a digit less fits beside it

std::string Budget(const SearchOptions& search) {
  std::string text = fmt::format("{} birds x {} iterations", search.population, search.iterations);
  const std::int64_t planned =
      static_cast<std::int64_t>(search.population) * (search.iterations + 1LL);
  return text + fmt::format(": {} evaluations at most", std::min(planned, search.max_evaluations));
}

// The budget of all contenders; empty where they differ.
std::string CommonBudget(const Comparison& comparison) {
  if (comparison.problems.empty()) return "";
  const auto& contenders = comparison.problems[0].contenders;
  const std::string budget = Budget(contenders[0].search);
  const bool same = std::all_of(contenders.begin(), contenders.end(), [&](const auto& contender) {
    return Budget(contender.search) == budget;
  });
  return same ? budget : "";
}

std::string ObjectiveText(const Comparison& comparison) {
  std::string text = ToText(comparison.options.objective);
  for (const EffectUse& use : comparison.options.with) text += ", with " + DescribeUse(use);
  return text;
}

// A count as whole number, "-" for NaN.
std::string Whole(double value) { return std::isnan(value) ? "-" : fmt::format("{:.0f}", value); }

std::string SpreadTable(const ProblemResult& problem, Spread ContenderResult::*stage, int digits) {
  TextTable table("lrrrrrrr");
  table.Add({"algorithm", "min", "mean", "median", "max", "std", "1e-9", "1e-6"});
  for (const ContenderResult& contender : problem.contenders) {
    if (contender.name.size() >= kLongName) digits = 5;
  }
  for (const ContenderResult& contender : problem.contenders) {
    const Spread& s = contender.*stage;
    table.Add({contender.name, Scientific(s.min, digits), Scientific(s.mean, digits),
               Scientific(s.median, digits), Scientific(s.max, digits), Scientific(s.std, 2),
               std::to_string(s.within_1e9), std::to_string(s.within_1e6)});
  }
  return table.Text();
}

std::string CostTable(const Comparison& comparison, const ProblemResult& problem) {
  const bool polish = comparison.options.polish;
  const bool plain = comparison.options.plain_polish;
  TextTable table("lrrrrrrrr");
  std::vector<std::string> head = {"algorithm", "evals", "to target", "hits", "search"};
  if (polish) head.insert(head.end(), {"polish", "all starts", "best bird"});
  if (plain) head.emplace_back("plain");
  table.Add(head);
  for (const ContenderResult& c : problem.contenders) {
    std::vector<std::string> row = {c.name, Whole(c.evaluations), Whole(c.expected_evaluations),
                                    std::to_string(c.target_hits), Duration(c.search_seconds)};
    if (polish) {
      row.insert(row.end(), {Duration(c.polish_seconds), std::to_string(c.polished.within_1e9),
                             std::to_string(c.own_polished.within_1e9)});
    }
    if (plain) row.push_back(std::to_string(c.plain_polished.within_1e9));
    table.Add(row);
  }
  return table.Text();
}

std::string ProblemText(const Comparison& comparison, const ProblemResult& problem) {
  const std::string objective = ObjectiveText(comparison);
  std::string text = "\n" + Wrap("", ProblemTitle(problem)) + ReferenceField(comparison, problem);
  text +=
      fmt::format("\n  Search alone: RMSE in A ({}) of {} runs, and runs within 1e-9 and 1e-6\n",
                  objective, RunsText(comparison, problem));
  text += SpreadTable(problem, &ContenderResult::searched, 6);
  if (comparison.options.polish) {
    text += fmt::format(
        "\n  Search and polish: RMSE in A ({}) of {} runs, and runs within 1e-9 and 1e-6\n",
        objective, RunsText(comparison, problem));
    text += SpreadTable(problem, &ContenderResult::polished, 7);
  }
  const bool levels = comparison.options.polish || comparison.options.plain_polish;
  text += fmt::format("\n  Cost of a run, runs whose search hits the target{} ({})\n",
                      levels ? ", runs within 1e-9 by polish" : "", ObjectiveText(comparison));
  text += CostTable(comparison, problem);
  const std::string ranks = RankSection(problem);
  if (!ranks.empty()) text += "\n" + ranks;
  const std::string verdict = PolishVerdict(problem);
  if (!verdict.empty()) text += "\n" + verdict;
  return text;
}

std::string Title(const Comparison& comparison) {
  if (comparison.problems.empty()) return "nothing was completed";
  const std::size_t contenders = comparison.problems[0].contenders.size();
  return fmt::format("{}, {} each, on {}", Plural(contenders, "algorithm"),
                     Plural(comparison.options.runs, "run"),
                     Plural(comparison.problems.size(), "problem"));
}

}  // namespace

std::string ProblemTitle(const ProblemResult& problem) {
  return fmt::format("{}, {} model, bounds {}", problem.curve_name, ModelTitle(problem.model),
                     problem.bounds_name);
}

std::string RunsText(const Comparison& comparison, const ProblemResult& problem) {
  if (problem.complete) return std::to_string(comparison.options.runs);
  std::size_t fewest = problem.contenders[0].runs.size(), most = fewest;
  for (const ContenderResult& contender : problem.contenders) {
    fewest = std::min(fewest, contender.runs.size());
    most = std::max(most, contender.runs.size());
  }
  const std::string done =
      fewest == most ? std::to_string(most) : fmt::format("{} to {}", fewest, most);
  return fmt::format("{} of {}", done, comparison.options.runs);
}

std::string InterruptedLine(const Comparison& comparison) {
  std::string doubts = DoubtLines(comparison.doubts);
  if (!comparison.interrupted) return doubts;
  return doubts +
         "INTERRUPTED: only the runs that were done are counted; RMSEs and ranks are of those.\n";
}

std::string SetUpSection(const Comparison& comparison) {
  const CompareOptions& options = comparison.options;
  const bool one = std::all_of(comparison.problems.begin(), comparison.problems.end(),
                               [&](const ProblemResult& problem) {
                                 return problem.problem.empty() || !options.with.empty();
                               });
  std::string text =
      one ? Field("objective",
                  fmt::format("{}: of search, polish and every RMSE below; constants {}",
                              ObjectiveText(comparison), ToText(options.constants)))
          : Field("objective", "of search, polish and RMSE: as each problem says; constants " +
                                   ToText(options.constants));
  const std::string budget = CommonBudget(comparison);
  if (!budget.empty()) text += Field("budget", budget + " a run");
  const char* const common = budget.empty() ? "" : ": in each run all start from the same points";
  text +=
      Field("runs", fmt::format("0 to {} of seed {}{}", options.runs - 1, options.seed, common));
  return text;
}

std::string ReferenceField(const Comparison& comparison, const ProblemResult& problem) {
  const Reference& reference = problem.reference;
  const bool open = !reference.certified && std::isnan(reference.lower_bound_A);
  std::string text =
      fmt::format("{} A {}, {}{}", Scientific(reference.rmse_A, 10), ObjectiveText(comparison),
                  reference.origin, open ? "; not proved to be the lowest" : "");
  if (!std::isnan(reference.floor_A)) {
    const double above = reference.rmse_A / reference.floor_A - 1;
    text += above <= kCertifiedGap
                ? "; no number of diodes goes lower"
                : fmt::format("; {} % above the floor of any number of diodes, {} A",
                              Significant(100 * above, 3), Scientific(reference.floor_A, 10));
  }
  return Field("reference", text);
}

std::string CompareText(const Comparison& comparison) {
  const CompareOptions& options = comparison.options;
  std::string text = InterruptedLine(comparison);
  text += fmt::format("lyrefit {}: {}\n", comparison.version, Title(comparison));
  text += SetUpSection(comparison);
  text += Field("target",
                fmt::format("of the search: {:g} above the reference (relative); evaluations to it "
                            "are those of all runs, each up to its hit, by hits",
                            options.target_gap));
  if (options.rankings && options.runs >= 2) {
    text += Field(
        "tests",
        fmt::format("with {} pairs the smallest possible exact p of Wilcoxon's test is 2^(1-{}) = "
                    "{:.2g}; equal pairs are left out, and polished answers within 1e-9 of each "
                    "other are equal",
                    options.runs, options.runs, std::exp2(1.0 - options.runs)));
  }
  text += Field("time", Duration(comparison.seconds));
  text += OverviewSection(comparison);
  for (const ProblemResult& problem : comparison.problems) text += ProblemText(comparison, problem);
  return text;
}

}  // namespace lyrefit
