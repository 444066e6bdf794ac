#include "lyrefit/study/report/compare_json.h"

#include <cmath>

#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/report/json_parts.h"
#include "lyrefit/study/report/compare_parts.h"
#include "lyrefit/study/report/problem_json.h"
#include "lyrefit/study/report/rank_json.h"

namespace lyrefit {

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

}  // namespace lyrefit
