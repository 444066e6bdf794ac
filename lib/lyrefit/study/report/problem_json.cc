#include "lyrefit/study/report/problem_json.h"

#include "lyrefit/study/problem_ranks.h"
#include "lyrefit/study/report/problem_verdict.h"
#include "lyrefit/study/report/rank_json.h"

namespace lyrefit {

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

}  // namespace

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

}  // namespace lyrefit
