#include "lyrefit/study/report/compare_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "lyrefit/report/csv.h"

namespace lyrefit {

std::string CompareCsv(const Comparison& comparison) {
  std::string csv =
      "curve,model,objective,bounds,algorithm,run,seed,searched_A,plain_polished_A,"
      "refined_best_candidate_A,refined_A,evaluations,curve_evaluations,evaluations_to_target,"
      "search_seconds,refine_seconds";
  const bool summarised = std::any_of(comparison.problems.begin(), comparison.problems.end(),
                                      [](const auto& problem) { return !problem.problem.empty(); });
  csv += summarised ? ",problem,reference_A,plain_seconds,best_candidate_seconds\n" : "\n";
  for (const ProblemResult& problem : comparison.problems) {
    const std::string begin =
        fmt::format("{},{},{},{}", CsvField(problem.curve_name), ToText(problem.model),
                    ToText(problem.objective), CsvField(problem.bounds_name));
    for (const AlgorithmResult& compared : problem.algorithms) {
      for (const RunRecord& run : compared.runs) {
        const std::int64_t to_target = run.evaluations_to_target;
        fmt::format_to(std::back_inserter(csv), "{},{},{},{},{},{},{},{},{},{},{},{},{}", begin,
                       CsvField(compared.name), run.run, comparison.options.seed,
                       CsvField(run.searched_A), CsvField(run.plain_polished_A),
                       CsvField(run.own_polished_A), CsvField(run.polished_A), run.evaluations,
                       run.curve_evaluations, to_target < 0 ? "" : std::to_string(to_target),
                       CsvField(run.search_seconds), CsvField(run.polish_seconds));
        if (summarised) {
          fmt::format_to(std::back_inserter(csv), ",{},{},{},{}", CsvField(problem.problem),
                         CsvField(problem.reference.rmse_A), CsvField(run.plain_seconds),
                         CsvField(run.own_seconds));
        }
        csv += '\n';
      }
    }
  }
  return csv;
}

}  // namespace lyrefit
