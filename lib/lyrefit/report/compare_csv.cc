#include "lyrefit/report/compare_csv.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace lyrefit {
namespace {

std::string Quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

std::string Number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

}  // namespace

std::string CompareCsv(const Comparison& comparison) {
  std::string csv =
      "curve,model,objective,bounds,algorithm,run,seed,searched_A,plain_polished_A,"
      "best_bird_polished_A,refined_A,evaluations,evaluations_to_target,search_seconds,"
      "refine_seconds\n";
  for (const ProblemResult& problem : comparison.problems) {
    const std::string begin =
        fmt::format("{},{},{},{}", Quoted(problem.curve_name), ToText(problem.model),
                    ToText(comparison.options.objective), Quoted(problem.bounds_name));
    for (const ContenderResult& contender : problem.contenders) {
      for (std::size_t r = 0; r < contender.runs.size(); ++r) {
        const RunRecord& run = contender.runs[r];
        const std::int64_t to_target = run.evaluations_to_target;
        fmt::format_to(std::back_inserter(csv), "{},{},{},{},{},{},{},{},{},{},{},{}\n", begin,
                       Quoted(contender.name), r, comparison.options.seed, Number(run.searched_A),
                       Number(run.plain_polished_A), Number(run.own_polished_A),
                       Number(run.polished_A), run.evaluations,
                       to_target < 0 ? "" : std::to_string(to_target), Number(run.search_seconds),
                       Number(run.polish_seconds));
      }
    }
  }
  return csv;
}

}  // namespace lyrefit
