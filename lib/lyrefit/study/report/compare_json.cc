#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/json_parts.h"
#include "lyrefit/study/comparison.h"
#include "lyrefit/study/problem_summary.h"
#include "lyrefit/study/report/compare_parts.h"
#include "lyrefit/study/report/documents.h"
#include "lyrefit/study/verdict.h"

namespace lyrefit {
namespace {

Json PairsJson(const std::vector<std::string>& names, const Ranking& ranking) {
  Json list = Json::array();
  for (const RankPair& pair : ranking.pairs) {
    list.push_back({{"first", names[pair.first]},
                    {"second", names[pair.second]},
                    {"mean_rank_difference", pair.difference},
                    {"low_95", pair.low_95},
                    {"high_95", pair.high_95},
                    {"p_value", pair.p_value},
                    {"p_sidak", pair.p_sidak},
                    {"p_holm", pair.p_holm}});
  }
  return list;
}

Json SignedRanksJson(const std::vector<std::string>& names, const Ranking& ranking) {
  Json list = Json::array();
  for (const Ranking::SignedRank& pair : ranking.signed_ranks) {
    const Wilcoxon& test = pair.test;
    list.push_back({{"first", names[pair.first]},
                    {"second", names[pair.second]},
                    {"pairs", test.pairs},
                    {"zeros", test.zeros},
                    {"ties", test.ties},
                    {"rank_sum_plus", test.rank_sum_plus},
                    {"rank_sum_minus", test.rank_sum_minus},
                    {"p_value", test.p_value},
                    {"exact", test.exact},
                    {"p_normal", test.p_normal},
                    {"smallest_p", test.smallest_p},
                    {"p_holm", pair.p_holm}});
  }
  return list;
}

// Friedman's test and every pair of the algorithms with these names. Null if there are no ranks.
Json RankingJson(const std::vector<std::string>& names, const Ranking& ranking) {
  if (ranking.friedman.algorithms == 0) return nullptr;
  return {{"friedman",
           {{"blocks", ranking.friedman.blocks},
            {"mean_rank", ranking.friedman.mean_rank},
            {"chi_square", ranking.friedman.chi_square},
            {"p_value", ranking.friedman.p_value}}},
          {"dunn", PairsJson(names, ranking)},
          {"wilcoxon", SignedRanksJson(names, ranking)}};
}

}  // namespace

void to_json(Json& j, const Failures& failures) {
  j = {{"runs", failures.runs},
       {"local_optima", failures.local_optima},
       {"commonest",
        {{"runs", failures.commonest},
         {"device", failures.commonest_device},
         {"excess", failures.commonest_excess}}},
       {"excess", {{"median", failures.median_excess}, {"max", failures.worst_excess}}},
       {"deviation",
        {{"median", failures.median_deviation},
         {"max", failures.worst_deviation},
         {"parameter", failures.worst_parameter}}}};
}

void to_json(Json& j, const LevelSummary& level) {
  const RunSpread& excess = level.excess;
  j = {{"runs", level.runs},
       {"hits", level.hits},
       {"excess",
        {{"min", excess.min},
         {"mean", excess.mean},
         {"median", excess.median},
         {"max", excess.max},
         {"std", excess.std}}},
       {"seconds", level.seconds}};
  if (level.failures.runs > 0) j["failures"] = level.failures;
}

// Levels that an algorithm does not have are null.
void to_json(Json& j, const AlgorithmSummary& compared) {
  LYREFIT_PUT_FIELDS(j, compared, name, algorithm, kind);
  j["budget"] = compared.budget > 0 ? Json(compared.budget) : Json();
  LYREFIT_PUT_FIELDS(j, compared, evaluations, curve_evaluations);
  j["searched"] = compared.At(PolishLevel::kSearch);
  j["plain_polished"] = compared.At(PolishLevel::kPlain);
  j["refined_best_candidate"] = compared.At(PolishLevel::kOwn);
  j["refined"] = compared.At(PolishLevel::kHybrid);
}

namespace {

Json AnswerJson(const ProblemSummary& summary) {
  const std::optional<PeerRatio> ratio = CompareWithPeers(summary);
  Json answer = {{"sentence", VerdictText(summary)}};
  if (!ratio || !ratio->peer) return answer;
  answer["peer"] = {{"name", ratio->peer->algorithm->name},
                    {"hits", ratio->peer->figures().hits},
                    {"repeats", ratio->repeats},
                    {"times_faster", ratio->times},
                    {"sentence", PeerText(summary)}};
  return answer;
}

Json RankingsJson(const std::vector<ProblemSummary>& summaries) {
  Json list = Json::array();
  for (const SummaryRanking& ranking : RankProblems(summaries)) {
    list.push_back({{"problem", ranking.problem.empty() ? Json() : Json(ranking.problem)},
                    {"budget", ranking.budget},
                    {"algorithms", ranking.names},
                    {"searched", RankingJson(ranking.names, ranking.searched)},
                    {"refined_best_candidate", RankingJson(ranking.names, ranking.own)}});
  }
  return list;
}

// Problems that are summarised over their devices (problem_summary.h), one object each, and
// the ranks of their searches. Empty object: there are none. Values that depend on wall-clock times
// are also under a key named `seconds`.
Json ProblemsJson(const Comparison& comparison) {
  const std::vector<ProblemSummary> summaries = SummariseProblems(comparison);
  if (summaries.empty()) return Json::object();
  Json problems = Json::array();
  for (const ProblemSummary& summary : summaries) {
    problems.push_back({{"problem", summary.name},
                        {"objective", summary.devices[0]->objective},
                        {"devices", summary.devices.size()},
                        {"certified", summary.certified},
                        {"hit_within", kHit},
                        {"answer", {{"seconds", AnswerJson(summary)}}},
                        {"algorithms", summary.algorithms}});
  }
  return {{"problems", std::move(problems)}, {"rankings", RankingsJson(summaries)}};
}

}  // namespace

// Null if the stage was not requested.
void to_json(Json& j, const RunSpread& spread) {
  j = nullptr;
  if (std::isnan(spread.min)) return;
  j = {{"min_A", spread.min},
       {"mean_A", spread.mean},
       {"median_A", spread.median},
       {"max_A", spread.max},
       {"std_A", spread.std},
       {"within_1e9", spread.within_1e9},
       {"within_1e6", spread.within_1e6}};
}

// The settings in which algorithms differ. Seed and run are written elsewhere.
void to_json(Json& j, const SearchOptions& search) {
  const bool limited = search.max_evaluations < SearchOptions().max_evaluations;
  j = {{"population", search.population},
       {"iterations", search.iterations},
       {"memory_rate", search.memory_rate},
       {"distance_coefficient", search.distance_coefficient},
       {"de_scale", search.de_scale},
       {"de_crossover", search.de_crossover},
       {"max_evaluations", limited ? Json(search.max_evaluations) : Json()},
       {"elites", search.elites}};
}

namespace {

Json Seconds(double value) { return {{"seconds", value}}; }

Json ReferenceJson(const ProblemResult& problem) {
  const Reference& reference = problem.reference;
  Json parameters = Json::object();
  for (std::size_t i = 0; i < reference.parameters.size() && i < problem.parameters.size(); ++i) {
    parameters[problem.parameters[i]] = reference.parameters[i];
  }
  return {{"rmse_A", reference.rmse_A},
          {"certified", reference.certified},
          {"lower_bound_A", reference.lower_bound_A},
          {"floor_A", reference.floor_A},
          {"origin", reference.origin},
          {"parameters", std::move(parameters)}};
}

Json RunsJson(const std::vector<RunRecord>& runs, bool summarised) {
  Json list = Json::array();
  for (const RunRecord& run : runs) {
    const bool hit = run.evaluations_to_target >= 0;
    list.push_back({{"run", run.run},
                    {"searched_A", run.searched_A},
                    {"plain_polished_A", run.plain_polished_A},
                    {"refined_best_candidate_A", run.own_polished_A},
                    {"refined_A", run.polished_A},
                    {"evaluations", run.evaluations},
                    {"curve_evaluations", run.curve_evaluations},
                    {"evaluations_to_target", hit ? Json(run.evaluations_to_target) : Json()},
                    {"search", Seconds(run.search_seconds)},
                    {"refine", Seconds(run.polish_seconds)}});
    if (!summarised) continue;
    Json& json = list.back();
    json["plain"] = Seconds(run.plain_seconds);
    json["best_candidate"] = Seconds(run.own_seconds);
    json["best_candidate_parameters"] = run.own_parameters;
    json["refined_parameters"] = run.parameters;
  }
  return list;
}

Json AlgorithmJson(const AlgorithmResult& compared, bool summarised) {
  Json evaluations = Json::array(), best = Json::array();
  for (const MedianPoint& point : compared.trace) {
    evaluations.push_back(point.evaluations);
    best.push_back(point.best_A);
  }
  return {
      {"name", compared.name},
      {"algorithm", compared.algorithm},
      {"settings", compared.search},
      {"searched", compared.searched},
      {"plain_polished", compared.plain_polished},
      {"refined_best_candidate", compared.own_polished},
      {"refined", compared.polished},
      {"evaluations", compared.evaluations},
      {"curve_evaluations", compared.curve_evaluations},
      {"target",
       {{"hits", compared.target_hits}, {"expected_evaluations", compared.expected_evaluations}}},
      {"search", Seconds(compared.search_seconds)},
      {"refine", Seconds(compared.polish_seconds)},
      {"median_trace", {{"evaluations", evaluations}, {"best_A", best}}},
      {"runs", RunsJson(compared.runs, summarised)}};
}

}  // namespace

void to_json(Json& j, const ProblemResult& problem) {
  const bool summarised = !problem.problem.empty();
  const std::vector<std::string> names = AlgorithmNames(problem);
  Json algorithms = Json::array();
  for (const AlgorithmResult& c : problem.algorithms) {
    algorithms.push_back(AlgorithmJson(c, summarised));
  }
  j = {{"curve", problem.curve_name},
       {"model", problem.model},
       {"bounds", problem.bounds_name},
       {"searched_as_logarithm", problem.log_searched},
       {"complete", problem.complete},
       {"reference", ReferenceJson(problem)},
       {"algorithms", std::move(algorithms)},
       {"ranking",
        {{"searched", RankingJson(names, problem.searched)},
         {"refined", RankingJson(names, problem.polished)}}}};
  if (!summarised) return;
  j["problem"] = problem.problem;
  if (const Reference& reference = problem.reference; reference.points > 0) {
    j["reference"]["multistart"] = {{"found_by_it_alone", reference.by_multistart},
                                    {"random_points", reference.points},
                                    {"visits", reference.visits}};
  }
  j["objective"] = problem.objective;
  for (const EffectUse& use : problem.with) j["with"].push_back(DescribeUse(use));
}

void to_json(Json& j, const Comparison& comparison) {
  const CompareOptions& options = comparison.options;
  j = {{"lyrefit_version", comparison.version},
       {"objective", options.objective},
       {"constants", options.constants},
       {"seed", options.seed},
       {"runs", options.runs},
       {"target_gap", options.target_gap},
       {"polish", options.polish},
       {"plain_polish", options.plain_polish}};
  for (const EffectUse& use : options.with) j["with"].push_back(DescribeUse(use));
  j["interrupted"] = comparison.interrupted;
  j["seconds"] = comparison.seconds;
  j["warnings"] = CompareWarnings(comparison);
  j["problems"] = comparison.problems;
  if (Json summaries = ProblemsJson(comparison); !summaries.empty())
    j["summaries"] = std::move(summaries);
  if (options.multistart > 0) j["multistart"] = options.multistart;
}

std::string CompareJson(const Comparison& comparison) { return Dump(comparison); }

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
