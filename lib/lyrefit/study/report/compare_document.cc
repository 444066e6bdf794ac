#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"
#include "lyrefit/study/report/compare_parts.h"
#include "lyrefit/study/report/compare_script.h"
#include "lyrefit/study/report/documents.h"

namespace lyrefit {
namespace {

// Limit for a terminal's width; the table of each curve has more digits.
constexpr int kOverviewDigits = 4;

constexpr std::size_t kLongName = 18;  // longer names leave less space for other columns

bool LongNames(const ProblemResult& problem) {
  return std::any_of(problem.algorithms.begin(), problem.algorithms.end(),
                     [](const auto& compared) { return compared.name.size() >= kLongName; });
}

// A count as whole number, "-" for NaN.
std::string Whole(double value) { return std::isnan(value) ? "-" : fmt::format("{:.0f}", value); }

block::Table SpreadTable(const ProblemResult& problem, RunSpread AlgorithmResult::*stage,
                         int digits, std::string caption) {
  block::Table table = {"lrrrrrrr",
                        {{"algorithm", "min", "mean", "median", "max", "std", "1e-9", "1e-6"}},
                        {},
                        std::move(caption)};
  if (LongNames(problem)) digits = 5;
  for (const AlgorithmResult& compared : problem.algorithms) {
    const RunSpread& s = compared.*stage;
    table.rows.push_back({compared.name, Scientific(s.min, digits), Scientific(s.mean, digits),
                          Scientific(s.median, digits), Scientific(s.max, digits),
                          Scientific(s.std, 2), std::to_string(s.within_1e9),
                          std::to_string(s.within_1e6)});
  }
  return table;
}

block::Table CostTable(const CompareOptions& options, const ProblemResult& problem) {
  const bool polish = options.polish;
  const bool plain = options.plain_polish;
  block::Table table = {
      "lrrrrrrrr",
      {{"algorithm", "evals", "to target", "hits", "search"}},
      {},
      fmt::format("Cost of a run, runs whose search hits the target{} ({})",
                  polish || plain ? ", runs within 1e-9 by polish" : "", ObjectiveText(options))};
  block::Table::Row& head = table.heads[0];
  if (polish) head.insert(head.end(), {"polish", "all starts", "best only"});
  if (plain) head.emplace_back("plain");
  table.alignment.resize(head.size());
  for (const AlgorithmResult& c : problem.algorithms) {
    block::Table::Row row = {c.name, Whole(c.evaluations), Whole(c.expected_evaluations),
                             std::to_string(c.target_hits), Duration(c.search_seconds)};
    if (polish) {
      row.insert(row.end(), {Duration(c.polish_seconds), std::to_string(c.polished.within_1e9),
                             std::to_string(c.own_polished.within_1e9)});
    }
    if (plain) row.push_back(std::to_string(c.plain_polished.within_1e9));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::vector<Section> CompareSections(const Comparison& comparison, const ProblemResult& problem) {
  const auto caption = [&](const char* what) {
    return fmt::format("{}: RMSE in A ({}) of {} runs, and runs within 1e-9 and 1e-6", what,
                       ObjectiveText(comparison.options), RunsText(comparison, problem));
  };
  Section section = ProblemSection(comparison, problem);
  AddTable(SpreadTable(problem, &AlgorithmResult::searched, 6, caption("Search alone")), &section);
  if (comparison.options.polish) {
    AddTable(SpreadTable(problem, &AlgorithmResult::polished, 7, caption("Search and polish")),
             &section);
  }
  AddTable(CostTable(comparison.options, problem), &section);
  return {std::move(section), RankSection(problem), PolishVerdict(problem)};
}

bool ManyCurves(const Comparison& comparison) {
  const auto& problems = comparison.problems;
  return std::any_of(problems.begin(), problems.end(), [&](const ProblemResult& problem) {
    return problem.curve_name != problems.front().curve_name;
  });
}

block::Table::Row OverviewRow(const AlgorithmResult& compared, bool polish, bool brief) {
  const RunSpread& s = compared.searched;
  block::Table::Row row = {compared.name,
                           Scientific(s.min, kOverviewDigits),
                           Scientific(s.mean, kOverviewDigits),
                           Scientific(s.median, kOverviewDigits),
                           Scientific(s.max, kOverviewDigits),
                           Scientific(s.std, 2)};
  if (polish) {
    const RunSpread& p = compared.polished;
    row.push_back(Scientific(p.min, kOverviewDigits));
    if (!brief) row.push_back(Scientific(p.max, kOverviewDigits));
    row.push_back(std::to_string(p.within_1e9));
  }
  return row;
}

// Every curve, model and algorithm in one table, so that the columns of all curves are aligned.
// Empty for a single curve.
Section OverviewSection(const Comparison& comparison) {
  if (!ManyCurves(comparison)) return {};
  const bool polish = comparison.options.polish;
  const bool brief = LongNames(comparison.problems.front());
  block::Table table = {"lrrrrrrrr", {{"algorithm", "min", "mean", "median", "max", "std"}}};
  block::Table::Row& head = table.heads[0];
  if (polish) head.emplace_back("polished");
  if (polish && !brief) head.emplace_back("to max");
  if (polish) head.emplace_back("1e-9");
  table.alignment.resize(head.size());
  for (const ProblemResult& problem : comparison.problems) {
    table.spans.push_back({table.rows.size(), ProblemTitle(problem)});
    for (const AlgorithmResult& compared : problem.algorithms) {
      table.rows.push_back(OverviewRow(compared, polish, brief));
    }
  }
  return {fmt::format("All curves: RMSE in A ({}) of {} runs of the search alone{}",
                      ToText(comparison.options.objective), comparison.options.runs,
                      polish ? ", and polished" : ""),
          {std::move(table)}};
}

// Sentences on the ranking after the polish, for comparisons of few problems.
std::string PolishVerdicts(const Comparison& comparison) {
  constexpr std::size_t kMostProblems = 4;
  const std::vector<ProblemResult>& problems = comparison.problems;
  std::string text;
  if (problems.size() > kMostProblems) return text;
  for (const ProblemResult& problem : problems) {
    for (const block::Any& any : PolishVerdict(problem).blocks) {
      const auto* const sentence = std::get_if<block::Sentence>(&any);
      if (sentence == nullptr) continue;
      text += (text.empty() ? "" : "\n") +
              (problems.size() > 1 ? ProblemTitle(problem) + ": " : std::string()) + sentence->text;
    }
  }
  return text;
}

std::string Title(const Comparison& comparison) {
  if (comparison.problems.empty()) return "nothing was completed";
  const std::size_t algorithms = comparison.problems[0].algorithms.size();
  return fmt::format("{}, {} each, on {}", Plural(algorithms, "algorithm"),
                     Plural(comparison.options.runs, "run"),
                     Plural(comparison.problems.size(), "problem"));
}

}  // namespace

Document CompareDocument(const Comparison& comparison) {
  const CompareOptions& options = comparison.options;
  Document document = {CompareBanners(comparison)};
  Section& head = document.head;
  head.heading = fmt::format("lyrefit {}: {}", comparison.version, Title(comparison));
  AddSetUp(comparison, &head);
  AddField("target",
           fmt::format("of the search: {:g} above the reference (relative); evaluations to it are "
                       "those of all runs, each up to its hit, by hits",
                       options.target_gap),
           &head);
  if (options.rankings && options.runs >= 2) {
    AddField("tests",
             fmt::format("with {} pairs the smallest possible exact p of Wilcoxon's test is "
                         "2^(1-{}) = {:.2g}; equal pairs are left out, and polished answers within "
                         "1e-9 of each other are equal",
                         options.runs, options.runs, std::exp2(1.0 - options.runs)),
             &head);
  }
  AddField("time", Duration(comparison.seconds), &head);
  if (!comparison.problems.empty()) {
    block::Figure boxes;
    boxes.caption = fmt::format(
        "How far above the reference the runs of each algorithm end, in A ({}): median, quartiles, "
        "whiskers to 1.5 times their distance, and what lies beyond. The tables below have the "
        "numbers.",
        ToText(comparison.options.objective));
    boxes.figure = BoxFigure(comparison);
    AddFigure(std::move(boxes), &head);
  }
  AddSections({OverviewSection(comparison)}, &document);
  for (const ProblemResult& problem : comparison.problems) {
    AddSections(CompareSections(comparison, problem), &document);
  }
  document.verdict = PolishVerdicts(comparison);
  return document;
}

std::string CompareText(const Comparison& comparison) {
  return DrawText(CompareDocument(comparison));
}

}  // namespace lyrefit
