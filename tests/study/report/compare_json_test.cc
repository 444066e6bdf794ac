#include "lyrefit/study/report/documents.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "golden.h"
#include "json_keys.h"
#include "sample_comparison.h"

namespace lyrefit {
namespace {

using nlohmann::json;

json Parsed(const Comparison& comparison) { return json::parse(CompareJson(comparison)); }

TEST(CompareJson, HoldsWhatTheComparisonHolds) {
  Golden golden("json_comparison");
  Comparison comparison = SampleComparison();
  golden.AddLong("a comparison", Outline(Parsed(comparison)));
  AlgorithmResult& compared = comparison.problems[0].algorithms[2];
  compared.plain_polished = {};
  compared.runs[0].plain_polished_A = kUnknown;
  compared.runs[1].searched_A = kInfinity;
  comparison.problems[0].polished = {};
  golden.AddLongChanges("what is not known", Outline(Parsed(comparison)));
  golden.Check();
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
