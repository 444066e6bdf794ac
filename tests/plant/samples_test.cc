#include "plant/samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "batch/substrates.h"
#include "plant/plant_runs.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class SamplesTest : public CellTaskTest {
 protected:
  SamplesTest() { additions_ = PlantAdditions({}, &found_); }

  std::string Results(const std::string& out) const {
    return ResultsIn(folder_.Path(out)) + FileText(folder_.Path(out) + "/samples.csv") +
           FileText(folder_.Path(out) + "/samples.jsonl");
  }

  PlantResults found_;
};

TEST_F(SamplesTest, ASampleHasItsStatisticsChampionAndYield) {
  const std::string lone = Named("t_1", TableOf({Lit("t", "forward", 6e-3)}));
  const std::string other = Named("t_2", TableOf({Lit("t", "forward", 4e-3)}));
  const auto done = Run({Named("s1", Substrate(5e-3)), lone, other}, "out");
  ASSERT_TRUE(done) << done.error().ToString();
  ASSERT_EQ(found_.samples.size(), 2U);
  const SampleSummary& sample = found_.samples[0];
  EXPECT_EQ(sample.pixels, 4);
  EXPECT_EQ(sample.working(), 2);
  EXPECT_EQ(sample.yield(), 0.5);
  EXPECT_THAT(sample.not_working, ElementsAre("c: shorted", "d: dead"));
  ASSERT_EQ(sample.directions.size(), 2U);
  EXPECT_THAT(sample.directions[0].champion, HasSubstr("s1/a"));
  EXPECT_EQ(sample.senses.at("normal"), 1);
  EXPECT_EQ(sample.senses.at("inverted"), 1);
  const Quartiles& jsc = sample.directions[0].quantities[1];
  EXPECT_EQ(jsc.count, 2);
  EXPECT_NEAR(jsc.median, 19, 1e-6);  // of 18 and 20
  EXPECT_NEAR(jsc.low, 18.5, 1e-6);
  EXPECT_NEAR(jsc.high, 19.5, 1e-6);
  const SampleSummary& files = found_.samples[1];
  EXPECT_EQ(files.name.substr(files.name.rfind('/') + 1), "t");
  EXPECT_EQ(files.pixels, 2);
  // The long name of the folder breaks lines anywhere.
  const std::string text =
      std::regex_replace(BatchText(*done), std::regex("\\s+"), std::string(" "));
  EXPECT_THAT(text, HasSubstr("2 of 4 work, yield 50 %"));
  EXPECT_THAT(text, HasSubstr("c: shorted; d: dead"));
  const auto rows = Lines("out/samples.jsonl");
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[1]["direction"], "reverse");
  EXPECT_EQ(rows[1]["shorted"], 1);
}

TEST_F(SamplesTest, ShardsMergeToTheBytesOfOneRun) {
  const std::vector<std::string> files = {Named("s1", Substrate(5e-3)),
                                          Named("s2", Substrate(4e-3))};
  ASSERT_TRUE(Run(files, "whole"));
  for (int k = 1; k <= 3; ++k) {
    const auto shard = Run(files, "shards", {k, 3});
    ASSERT_TRUE(shard) << shard.error().ToString();
  }
  const auto merged =
      MergeShards({folder_.Path("shards")}, MergedInto(folder_.Path("merged"), &found_));
  ASSERT_TRUE(merged) << merged.error().ToString();
  EXPECT_EQ(Results("merged"), Results("whole"));
  EXPECT_EQ(found_.samples.size(), 2U);
  EXPECT_THAT(found_.working_pixel, HasSubstr("A pixel works if"));
}

TEST_F(SamplesTest, TheCriterionIsAnOption) {
  PixelOptions pixels;
  pixels.least_efficiency_percent = 90;
  const auto done = Run({Named("s1", Substrate(5e-3))}, "out", {}, pixels);
  ASSERT_TRUE(done) << done.error().ToString();
  EXPECT_EQ(found_.samples[0].working(), 0);
  EXPECT_THAT(found_.samples[0].not_working,
              ElementsAre("a: weak", "b: weak", "c: shorted", "d: dead"));
  EXPECT_THAT(BatchText(*done), HasSubstr("Weak: efficiency below 90 %"));
}

TEST_F(SamplesTest, WhatCannotBeReadIsCountedAndNamed) {
  const std::string bad = folder_.Write("bad.csv", "voltage (V),current (A)\n0,1\n");
  const auto done = Run({bad, Named("s1", TableOf({Lit("a", "forward", 5e-3)}))}, "out");
  ASSERT_TRUE(done) << done.error().ToString();
  EXPECT_EQ(done->rows, 2);
  EXPECT_THAT(found_.samples[0].not_working, ElementsAre("bad: broken"));
  EXPECT_EQ(found_.samples[0].yield(), 0);
}

}  // namespace
}  // namespace lyrefit
