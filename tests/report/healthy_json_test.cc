#include "lyrefit/report/json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "sample_diagnosis.h"
#include "sample_healthy.h"

namespace lyrefit {
namespace {

using nlohmann::json;

TEST(HealthyJson, HoldsTheComparisonAndTheDiagnosis) {
  const json j = json::parse(HealthyJson(SampleHealthy(), SampleDiagnosis()));
  EXPECT_EQ(j["diagnosis"]["name"], "sample_module");
  const json& c = j["comparison"];
  EXPECT_EQ(c["name"], "today");
  EXPECT_EQ(c["differs"], true);
  EXPECT_EQ(c["p_value"], 3e-6);
  EXPECT_EQ(c["common"], 0.0011);
  EXPECT_EQ(c["references"].size(), 12U);
  EXPECT_EQ(c["rows"][0]["symbol"], "FF");
  EXPECT_EQ(c["rows"][0]["expected"], 73.7);
  EXPECT_EQ(c["rows"][0]["power"], -0.0068);
  EXPECT_TRUE(c["rows"][1]["power"].is_null());
  EXPECT_EQ(c["causes"][0]["id"], "series_resistance");
  EXPECT_EQ(c["causes"][0]["size"], 8);
}

TEST(OddSweepsJson, ListsAllSweeps) {
  const json j = json::parse(OddSweepsJson(SampleOddSweeps()));
  EXPECT_EQ(j["odd"], 1);
  ASSERT_EQ(j["sweeps"].size(), 2U);
  EXPECT_EQ(j["sweeps"][1]["differs"], false);
  EXPECT_EQ(j["rejected"][0], "night: the curve is dark");
}

}  // namespace
}  // namespace lyrefit
