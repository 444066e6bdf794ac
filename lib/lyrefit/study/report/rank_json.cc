#include "lyrefit/study/report/rank_json.h"

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

}  // namespace

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

}  // namespace lyrefit
