#include "lyrefit/study/report/documents.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "json_keys.h"
#include "sample_comparison.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

json Parsed(const Comparison& comparison) { return json::parse(CompareJson(comparison)); }

TEST(CompareJson, HoldsExactlyTheKeysOfTheContract) {
  using Set = std::set<std::string>;
  const json j = Parsed(SampleComparison());
  EXPECT_EQ(Keys(j),
            (Set{"lyrefit_version", "objective", "constants", "seed", "runs", "target_gap",
                 "polish", "plain_polish", "interrupted", "seconds", "warnings", "problems"}));
  const json& problem = j["problems"][0];
  EXPECT_EQ(Keys(problem), (Set{"curve", "model", "bounds", "searched_as_logarithm", "complete",
                                "reference", "algorithms", "ranking"}));
  EXPECT_EQ(Keys(problem["reference"]),
            (Set{"rmse_A", "certified", "lower_bound_A", "floor_A", "origin", "parameters"}));
  const json& compared = problem["algorithms"][0];
  EXPECT_EQ(Keys(compared),
            (Set{"name", "algorithm", "settings", "searched", "plain_polished",
                 "refined_best_candidate", "refined", "evaluations", "curve_evaluations", "target",
                 "search", "refine", "median_trace", "runs"}));
  EXPECT_EQ(Keys(compared["settings"]),
            (Set{"population", "iterations", "memory_rate", "distance_coefficient", "de_scale",
                 "de_crossover", "max_evaluations", "elites"}));
  EXPECT_EQ(Keys(compared["searched"]),
            (Set{"min_A", "mean_A", "median_A", "max_A", "std_A", "within_1e9", "within_1e6"}));
  EXPECT_EQ(Keys(compared["runs"][0]),
            (Set{"run", "searched_A", "plain_polished_A", "refined_best_candidate_A", "refined_A",
                 "evaluations", "curve_evaluations", "evaluations_to_target", "search", "refine"}));
  EXPECT_EQ(Keys(problem["ranking"]), (Set{"searched", "refined"}));
  const json& ranking = problem["ranking"]["searched"];
  EXPECT_EQ(Keys(ranking), (Set{"friedman", "dunn", "wilcoxon"}));
  EXPECT_EQ(Keys(ranking["friedman"]), (Set{"blocks", "mean_rank", "chi_square", "p_value"}));
  EXPECT_EQ(Keys(ranking["dunn"][0]), (Set{"first", "second", "mean_rank_difference", "low_95",
                                           "high_95", "p_value", "p_sidak", "p_holm"}));
  EXPECT_EQ(Keys(ranking["wilcoxon"][0]),
            (Set{"first", "second", "pairs", "zeros", "ties", "rank_sum_plus", "rank_sum_minus",
                 "p_value", "exact", "p_normal", "smallest_p", "p_holm"}));
}

TEST(CompareJson, BringsBackTheSameBits) {
  const Comparison comparison = SampleComparison();
  const json j = Parsed(comparison);
  const AlgorithmResult& random = comparison.problems[1].algorithms[2];
  const json& compared = j["problems"][1]["algorithms"][2];
  EXPECT_EQ(compared["name"], "random");
  EXPECT_EQ(compared["searched"]["std_A"].get<double>(), random.searched.std);
  EXPECT_EQ(compared["runs"][3]["refined_A"].get<double>(), random.runs[3].polished_A);
  EXPECT_EQ(compared["runs"][3]["run"], 3);
  EXPECT_EQ(compared["median_trace"]["best_A"].back().get<double>(), random.trace.back().best_A);
  EXPECT_EQ(compared["median_trace"]["evaluations"].size(), random.trace.size());
  EXPECT_EQ(j["problems"][0]["reference"]["parameters"]["n"], 1.48);
}

TEST(CompareJson, WritesNullForWhatIsNotKnown) {
  Comparison comparison = SampleComparison();
  AlgorithmResult& compared = comparison.problems[0].algorithms[2];
  compared.plain_polished = {};
  compared.runs[0].plain_polished_A = kUnknown;
  compared.runs[1].searched_A = kInfinity;
  comparison.problems[0].polished = {};
  const json j = Parsed(comparison);
  const json& c = j["problems"][0]["algorithms"][2];
  EXPECT_TRUE(c["plain_polished"].is_null());
  EXPECT_TRUE(c["runs"][0]["plain_polished_A"].is_null());
  EXPECT_TRUE(c["runs"][1]["searched_A"].is_null());
  EXPECT_TRUE(c["runs"][0]["evaluations_to_target"].is_null());
  EXPECT_TRUE(c["target"]["expected_evaluations"].is_null());
  EXPECT_TRUE(c["settings"]["max_evaluations"].is_null());
  EXPECT_TRUE(j["problems"][0]["reference"]["lower_bound_A"].is_null());
  EXPECT_TRUE(j["problems"][0]["ranking"]["refined"].is_null());
  const std::string text = CompareJson(comparison);
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  EXPECT_THAT(text, Not(HasSubstr("inf")));
}

TEST(CompareJson, KeepsWallClockTimesUnderSecondsOnly) {
  Comparison comparison = SampleComparison();
  json first = Parsed(comparison);
  comparison.seconds = 77;
  comparison.options.threads = 9;
  comparison.problems[0].algorithms[0].search_seconds = 77;
  comparison.problems[0].algorithms[1].polish_seconds = 77;
  comparison.problems[0].algorithms[1].runs[2].search_seconds = 77;
  comparison.problems[0].algorithms[1].runs[2].polish_seconds = 77;
  json second = Parsed(comparison);
  EXPECT_NE(first, second);
  RemoveSeconds(&first);
  RemoveSeconds(&second);
  EXPECT_EQ(first, second);
}

TEST(CompareJson, SurvivesNamesThatAreNotUtf8) {
  Comparison comparison = SampleComparison();
  comparison.problems[0].curve_name = "caf\xe9";
  EXPECT_EQ(Parsed(comparison)["problems"][0]["curve"], "caf\xef\xbf\xbd");
}

}  // namespace
}  // namespace lyrefit
