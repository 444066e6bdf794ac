#include "lyrefit/study/report/pool_json.h"

#include "lyrefit/study/pool_ranks.h"
#include "lyrefit/study/report/pool_verdict.h"
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

void to_json(Json& j, const PooledLevel& level) {
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

// Null are the levels a contender does not have.
void to_json(Json& j, const PooledContender& contender) {
  j = {{"name", contender.name},
       {"algorithm", contender.algorithm},
       {"kind", contender.kind},
       {"budget", contender.budget > 0 ? Json(contender.budget) : Json()},
       {"evaluations", contender.evaluations},
       {"curve_evaluations", contender.curve_evaluations},
       {"searched", contender.At(PolishLevel::kSearch)},
       {"plain_polished", contender.At(PolishLevel::kPlain)},
       {"refined_best_candidate", contender.At(PolishLevel::kOwn)},
       {"refined", contender.At(PolishLevel::kHybrid)}};
}

namespace {

Json AnswerJson(const PooledProblem& pool) {
  const std::optional<PeerRatio> ratio = CompareWithPeers(pool);
  Json answer = {{"sentence", VerdictText(pool)}};
  if (!ratio || !ratio->peer) return answer;
  answer["peer"] = {{"name", ratio->peer->contender->name},
                    {"hits", ratio->peer->figures().hits},
                    {"repeats", ratio->repeats},
                    {"times_faster", ratio->times},
                    {"sentence", PeerText(pool)}};
  return answer;
}

Json RankingsJson(const std::vector<PooledProblem>& pools) {
  Json list = Json::array();
  for (const PooledRanking& ranking : RankPools(pools)) {
    list.push_back({{"problem", ranking.problem.empty() ? Json() : Json(ranking.problem)},
                    {"budget", ranking.budget},
                    {"algorithms", ranking.names},
                    {"searched", RankingJson(ranking.names, ranking.searched)},
                    {"refined_best_candidate", RankingJson(ranking.names, ranking.own)}});
  }
  return list;
}

}  // namespace

Json PoolsJson(const Comparison& comparison) {
  const std::vector<PooledProblem> pools = PoolProblems(comparison);
  if (pools.empty()) return Json::object();
  Json problems = Json::array();
  for (const PooledProblem& pool : pools) {
    problems.push_back({{"problem", pool.name},
                        {"objective", pool.devices[0]->objective},
                        {"devices", pool.devices.size()},
                        {"certified", pool.certified},
                        {"hit_within", kPoolHit},
                        {"answer", {{"seconds", AnswerJson(pool)}}},
                        {"contenders", pool.contenders}});
  }
  return {{"problems", std::move(problems)}, {"rankings", RankingsJson(pools)}};
}

}  // namespace lyrefit
