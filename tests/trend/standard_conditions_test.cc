#include "lyrefit/trend/standard_conditions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "synthetic/draw.h"

namespace lyrefit {
namespace {

constexpr Features kTrueDeparture = {0.02, -0.05, 0.01, 0.004, -0.002};

// Values of 60 days, whose light and warmth rise over the season.
std::vector<ConditionedValue> DrawDays(double noise, double rise, double outlier) {
  RandomStream random(36);
  std::vector<ConditionedValue> values;
  for (int day = 0; day < 60; ++day) {
    const double level = 3 + rise * day;
    for (int k = 0; k < 10; ++k) {
      ConditionedValue one;
      one.block = day;
      const double light = Between(&random, 0.2, 0.6 + 0.007 * day);
      one.features = FeaturesAt(light, Between(&random, 10, 25) + 30 * light + 0.2 * day);
      one.value = level + Departure(kTrueDeparture, one.features) + noise * random.Normal();
      if (k == 5 && day % 3 == 0) one.value += outlier;
      values.push_back(one);
    }
  }
  return values;
}

TEST(FeaturesAt, AreZeroAtStandardConditions) {
  for (const double feature : FeaturesAt(1, 25)) EXPECT_EQ(feature, 0);
  const Features warm = FeaturesAt(std::exp(-1), 45);
  EXPECT_DOUBLE_EQ(warm[0], 2);
  EXPECT_DOUBLE_EQ(warm[1], -1);
  EXPECT_DOUBLE_EQ(warm[2], 1);
  EXPECT_DOUBLE_EQ(warm[3], -2);
  EXPECT_DOUBLE_EQ(warm[4], 4);
}

TEST(FeaturesAt, StayWhatTheyAreInTheDark) { EXPECT_EQ(FeaturesAt(0, 30), FeaturesAt(0.05, 30)); }

TEST(FitWithinBlocks, FindsTheDeparture) {
  const Features exact = FitWithinBlocks(DrawDays(0, 0, 0));
  const Features noisy = FitWithinBlocks(DrawDays(0.002, 0, 0));
  for (int f = 0; f < kConditionFeatures; ++f) {
    EXPECT_NEAR(exact[f], kTrueDeparture[f], 1e-9) << f;
    EXPECT_NEAR(noisy[f], kTrueDeparture[f], 0.006) << f;
  }
}

TEST(FitWithinBlocks, NoTrendGetsIntoIt) {
  const Features still = FitWithinBlocks(DrawDays(0.002, 0, 0));
  const Features rising = FitWithinBlocks(DrawDays(0.002, 0.1, 0));
  for (int f = 0; f < kConditionFeatures; ++f) EXPECT_NEAR(still[f], rising[f], 1e-9) << f;
}

TEST(FitWithinBlocks, OutliersDoNotSteerIt) {
  const Features found = FitWithinBlocks(DrawDays(0.002, 0, 5));
  for (int f = 0; f < kConditionFeatures; ++f) {
    EXPECT_NEAR(found[f], kTrueDeparture[f], 0.005) << f;
  }
}

TEST(FitWithinBlocks, IsZeroWithTooFewValues) {
  std::vector<ConditionedValue> values = DrawDays(0, 0, 0);
  std::vector<ConditionedValue> two_a_day;
  for (std::size_t i = 0; i < values.size(); i += 5) two_a_day.push_back(values[i]);
  EXPECT_EQ(FitWithinBlocks(two_a_day), Features{});
  values.resize(29);
  EXPECT_EQ(FitWithinBlocks(values), Features{});
  EXPECT_EQ(FitWithinBlocks({}), Features{});
}

TEST(BlockMean, IsTheLevelAtStandardConditions) {
  std::vector<ConditionedValue> day = DrawDays(0, 0, 0);
  day.resize(10);
  EXPECT_NEAR(BlockMean(day, kTrueDeparture), 3, 1e-12);
}

TEST(BlockMean, AnOutlierDoesNotSteerIt) {
  std::vector<ConditionedValue> day = DrawDays(0.01, 0, 0);
  day.resize(10);
  const double clean = BlockMean(day, kTrueDeparture);
  day[5].value += 1000;
  EXPECT_NEAR(BlockMean(day, kTrueDeparture), clean, 0.02);
}

}  // namespace
}  // namespace lyrefit
