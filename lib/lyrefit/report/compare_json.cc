#include "lyrefit/report/compare_json.h"

#include "lyrefit/report/json_parts.h"
#include "lyrefit/report/pool_json.h"
#include "lyrefit/report/rank_json.h"

namespace lyrefit {
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

// Null where that stage was not asked for.
Json SpreadJson(const Spread& spread) {
  if (std::isnan(spread.min)) return nullptr;
  return {{"min_A", spread.min},
          {"mean_A", spread.mean},
          {"median_A", spread.median},
          {"max_A", spread.max},
          {"std_A", spread.std},
          {"within_1e9", spread.within_1e9},
          {"within_1e6", spread.within_1e6}};
}

Json RunsJson(const std::vector<RunRecord>& runs, bool pooled) {
  Json list = Json::array();
  for (const RunRecord& run : runs) {
    const bool hit = run.evaluations_to_target >= 0;
    list.push_back({{"run", run.run},
                    {"searched_A", run.searched_A},
                    {"plain_polished_A", run.plain_polished_A},
                    {"best_bird_polished_A", run.own_polished_A},
                    {"refined_A", run.polished_A},
                    {"evaluations", run.evaluations},
                    {"curve_evaluations", run.curve_evaluations},
                    {"evaluations_to_target", hit ? Json(run.evaluations_to_target) : Json()},
                    {"search", Seconds(run.search_seconds)},
                    {"refine", Seconds(run.polish_seconds)}});
    if (!pooled) continue;
    Json& json = list.back();
    json["plain"] = Seconds(run.plain_seconds);
    json["best_bird"] = Seconds(run.own_seconds);
    json["best_bird_parameters"] = run.own_parameters;
    json["refined_parameters"] = run.parameters;
  }
  return list;
}

// The settings that tell contenders apart; seed and run stand elsewhere.
Json SettingsJson(const SearchOptions& search) {
  const bool limited = search.max_evaluations < SearchOptions().max_evaluations;
  return {{"population", search.population},
          {"iterations", search.iterations},
          {"memory_rate", search.memory_rate},
          {"distance_coefficient", search.distance_coefficient},
          {"de_scale", search.de_scale},
          {"de_crossover", search.de_crossover},
          {"max_evaluations", limited ? Json(search.max_evaluations) : Json()},
          {"elites", search.elites}};
}

Json ContenderJson(const ContenderResult& contender, const ProblemResult& problem) {
  Json evaluations = Json::array();
  Json best = Json::array();
  for (const MedianPoint& point : contender.trace) {
    evaluations.push_back(point.evaluations);
    best.push_back(point.best_A);
  }
  return {
      {"name", contender.name},
      {"algorithm", contender.algorithm},
      {"settings", SettingsJson(contender.search)},
      {"birds", ToText(contender.birds)},
      {"searched", SpreadJson(contender.searched)},
      {"plain_polished", SpreadJson(contender.plain_polished)},
      {"best_bird_polished", SpreadJson(contender.own_polished)},
      {"refined", SpreadJson(contender.polished)},
      {"evaluations", contender.evaluations},
      {"curve_evaluations", contender.curve_evaluations},
      {"target",
       {{"hits", contender.target_hits}, {"expected_evaluations", contender.expected_evaluations}}},
      {"search", Seconds(contender.search_seconds)},
      {"refine", Seconds(contender.polish_seconds)},
      {"median_trace", {{"evaluations", evaluations}, {"best_A", best}}},
      {"runs", RunsJson(contender.runs, !problem.problem.empty())}};
}

std::vector<std::string> ContenderNames(const ProblemResult& problem) {
  std::vector<std::string> names;
  for (const ContenderResult& contender : problem.contenders) names.push_back(contender.name);
  return names;
}

Json ProblemJson(const ProblemResult& problem) {
  Json contenders = Json::array();
  for (const ContenderResult& c : problem.contenders)
    contenders.push_back(ContenderJson(c, problem));
  Json json = {{"curve", problem.curve_name},
               {"model", ToText(problem.model)},
               {"bounds", problem.bounds_name},
               {"complete", problem.complete},
               {"reference", ReferenceJson(problem)},
               {"contenders", std::move(contenders)},
               {"ranking",
                {{"searched", RankingJson(ContenderNames(problem), problem.searched)},
                 {"refined", RankingJson(ContenderNames(problem), problem.polished)}}}};
  if (problem.problem.empty()) return json;
  json["problem"] = problem.problem;
  if (const Reference& reference = problem.reference; reference.points > 0) {
    json["reference"]["multistart"] = {{"found_by_it_alone", reference.by_multistart},
                                       {"random_points", reference.points},
                                       {"visits", reference.visits}};
  }
  json["objective"] = ToText(problem.objective);
  for (const EffectUse& use : problem.with) json["with"].push_back(DescribeUse(use));
  return json;
}

}  // namespace

std::string CompareJson(const Comparison& comparison) {
  const CompareOptions& options = comparison.options;
  Json json;
  json["lyrefit_version"] = comparison.version;
  json["objective"] = ToText(options.objective);
  json["constants"] = ToText(options.constants);
  json["seed"] = options.seed;
  json["runs"] = options.runs;
  json["target_gap"] = options.target_gap;
  json["polish"] = options.polish;
  json["plain_polish"] = options.plain_polish;
  for (const EffectUse& use : options.with) json["with"].push_back(DescribeUse(use));
  json["interrupted"] = comparison.interrupted;
  json["seconds"] = comparison.seconds;
  json["warnings"] = comparison.doubts;
  json["problems"] = Json::array();
  for (const ProblemResult& problem : comparison.problems) {
    json["problems"].push_back(ProblemJson(problem));
  }
  if (Json pools = PoolsJson(comparison); !pools.empty()) json["pools"] = std::move(pools);
  if (options.multistart > 0) json["multistart"] = options.multistart;
  // Names and files may hold bytes that are not UTF-8.
  return Dump(json);
}

}  // namespace lyrefit
