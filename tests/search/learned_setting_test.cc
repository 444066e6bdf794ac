#include "lyrefit/search/learned_setting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lyrefit {
namespace {

double MeanDraw(LearnedSetting setting) {
  RandomStream random(2);
  double sum = 0;
  for (int k = 0; k < 20000; ++k) {
    const double value = setting.Draw(&random);
    EXPECT_GE(value, 0);
    EXPECT_LE(value, 1);
    sum += value / 20000;
  }
  return sum;
}

TEST(LearnedSetting, BeginsAroundItsFirstValue) {
  EXPECT_NEAR(MeanDraw(LearnedSetting(0.5)), 0.5, 0.01);
}

TEST(LearnedSetting, RemembersTheMeanOfWhatGainedWeightedByTheGain) {
  LearnedSetting weighted(0.5);
  LearnedSetting plain(0.5);
  for (int iteration = 0; iteration < 5; ++iteration) {  // the length of its memory
    weighted.Gained(0.2, 3);
    weighted.Gained(0.6, 1);
    weighted.EndIteration();
    plain.Gained(0.3, 1e-9);
    plain.EndIteration();
  }
  EXPECT_NEAR(MeanDraw(weighted), MeanDraw(plain), 1e-12);
}

TEST(LearnedSetting, KeepsWhatItKnowsWhereNothingGained) {
  LearnedSetting setting(0.4);
  setting.EndIteration();
  setting.Gained(1, std::numeric_limits<double>::infinity());  // its candidate had no value before
  setting.EndIteration();
  EXPECT_EQ(MeanDraw(setting), MeanDraw(LearnedSetting(0.4)));
}

// The gain of a move grows with the value of the setting.
TEST(LearnedSetting, FollowsTheGain) {
  LearnedSetting setting(0.2);
  RandomStream random(3);
  for (int iteration = 0; iteration < 50; ++iteration) {
    for (int move = 0; move < 20; ++move) {
      const double value = setting.Draw(&random);
      setting.Gained(value, value);
    }
    setting.EndIteration();
  }
  EXPECT_GT(MeanDraw(setting), 0.6);
}

}  // namespace
}  // namespace lyrefit
