#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/number_text.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/study/report/compare_parts.h"
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

using AlgorithmColumn = ColumnOf<AlgorithmResult>;

AlgorithmColumn NameColumn() {
  return {"algorithm", [](const auto& c) { return c.name; }};
}

AlgorithmColumn NumberColumn(const char* head, RunSpread AlgorithmResult::*stage,
                             double RunSpread::*field, int digits, bool shown = true) {
  return {head, [=](const auto& c) { return Scientific(c.*stage.*field, digits); }, shown};
}

AlgorithmColumn HitColumn(const char* head, RunSpread AlgorithmResult::*stage, int RunSpread::*hits,
                          bool shown = true) {
  return {head, [=](const auto& c) { return std::to_string(c.*stage.*hits); }, shown};
}

// The RMSEs of the runs at a stage.
std::vector<AlgorithmColumn> SpreadColumns(RunSpread AlgorithmResult::*stage, int digits) {
  return {NameColumn(),
          NumberColumn("min", stage, &RunSpread::min, digits),
          NumberColumn("mean", stage, &RunSpread::mean, digits),
          NumberColumn("median", stage, &RunSpread::median, digits),
          NumberColumn("max", stage, &RunSpread::max, digits),
          NumberColumn("std", stage, &RunSpread::std, 2)};
}

block::Table SpreadTable(const ProblemResult& problem, RunSpread AlgorithmResult::*stage,
                         int digits, std::string caption) {
  std::vector<AlgorithmColumn> columns = SpreadColumns(stage, LongNames(problem) ? 5 : digits);
  columns.push_back(HitColumn("1e-9", stage, &RunSpread::within_1e9));
  columns.push_back(HitColumn("1e-6", stage, &RunSpread::within_1e6));
  return TableOf(problem.algorithms, columns, std::move(caption));
}

block::Table CostTable(const CompareOptions& options, const ProblemResult& problem) {
  const bool polish = options.polish;
  const bool plain = options.plain_polish;
  const std::vector<AlgorithmColumn> columns = {
      NameColumn(),
      {"evals", [](const auto& c) { return Whole(c.evaluations); }},
      {"to target", [](const auto& c) { return Whole(c.expected_evaluations); }},
      {"hits", [](const auto& c) { return std::to_string(c.target_hits); }},
      {"search", [](const auto& c) { return Duration(c.search_seconds); }},
      {"polish", [](const auto& c) { return Duration(c.polish_seconds); }, polish},
      HitColumn("all starts", &AlgorithmResult::polished, &RunSpread::within_1e9, polish),
      HitColumn("best only", &AlgorithmResult::own_polished, &RunSpread::within_1e9, polish),
      HitColumn("plain", &AlgorithmResult::plain_polished, &RunSpread::within_1e9, plain)};
  return TableOf(
      problem.algorithms, columns,
      fmt::format("Cost of a run, runs whose search hits the target{} ({})",
                  polish || plain ? ", runs within 1e-9 by polish" : "", ObjectiveText(options)));
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

// Every curve, model and algorithm in one table, so that the columns of all curves are aligned.
// Empty for a single curve.
Section OverviewSection(const Comparison& comparison) {
  if (!ManyCurves(comparison)) return {};
  const bool polish = comparison.options.polish;
  const bool brief = LongNames(comparison.problems.front());
  std::vector<AlgorithmColumn> columns = SpreadColumns(&AlgorithmResult::searched, kOverviewDigits);
  const auto polished = &AlgorithmResult::polished;
  columns.push_back(NumberColumn("polished", polished, &RunSpread::min, kOverviewDigits, polish));
  columns.push_back(
      NumberColumn("to max", polished, &RunSpread::max, kOverviewDigits, polish && !brief));
  columns.push_back(HitColumn("1e-9", polished, &RunSpread::within_1e9, polish));
  block::Table table = TableOf({}, columns);
  for (const ProblemResult& problem : comparison.problems) {
    table.spans.push_back({table.rows.size(), ProblemTitle(problem)});
    AddRows(problem.algorithms, columns, &table);
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
           fmt::format("a search hits it within {:g} of the reference (relative). Evaluations to "
                       "it are those of all runs, each up to its hit, divided by the hits",
                       options.target_gap),
           &head);
  if (options.rankings && options.runs >= 2) {
    AddField("tests",
             fmt::format("with {} pairs the smallest possible exact p of Wilcoxon's test is "
                         "2^(1-{}) = {:.2g}. Equal pairs are left out. Polished answers within "
                         "1e-9 of each other count as equal",
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
