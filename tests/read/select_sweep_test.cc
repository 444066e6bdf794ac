#include "lyrefit/read/table_curve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

IvCurve UpAndDown() {
  IvCurve curve;
  curve.voltage_V = {0, 0.3, 0.6, 0.6, 0.3, 0};
  curve.current_A = {1, 0.9, 0, 0.1, 0.95, 1};
  curve.time_s = {0, 1, 2, 3, 4, 5};
  curve.sweep = {0, 0, 0, 1, 1, 1};
  return curve;
}

TEST(SelectSweepTest, UpAndDownStayTogetherAndAreSaid) {
  IvCurve curve = UpAndDown();
  ASSERT_TRUE(SelectSweep({}, false, &curve));
  EXPECT_EQ(curve.size(), 6U);
  EXPECT_THAT(SentencesOf(curve.assumptions), ElementsAre(HasSubstr("2 sweeps up and down")));
}

TEST(SelectSweepTest, WishPicksTheRowsOfEveryColumn) {
  IvCurve curve = UpAndDown();
  curve.irradiance_W_m2 = {1, 2, 3, 4, 5, 6};
  ASSERT_TRUE(SelectSweep(1, false, &curve));
  EXPECT_THAT(curve.voltage_V, ElementsAre(0.6, 0.3, 0));
  EXPECT_THAT(curve.current_A, ElementsAre(0.1, 0.95, 1));
  EXPECT_THAT(curve.time_s, ElementsAre(3, 4, 5));
  EXPECT_THAT(curve.irradiance_W_m2, ElementsAre(4, 5, 6));
  EXPECT_THAT(curve.sweep, ElementsAre(1, 1, 1));
  EXPECT_TRUE(curve.sigma_A.empty());
}

TEST(SelectSweepTest, OneSweepNeedsNoWish) {
  IvCurve curve = UpAndDown();
  curve.sweep.assign(6, 4);
  EXPECT_TRUE(SelectSweep({}, false, &curve));
  EXPECT_TRUE(SelectSweep({}, true, &curve));
  EXPECT_TRUE(SelectSweep(4, true, &curve));
  EXPECT_EQ(curve.size(), 6U);
}

TEST(SelectSweepTest, DifferentConditionsNeedAWish) {
  IvCurve bright = UpAndDown();
  bright.irradiance_W_m2 = {1000, 1000, 1000, 970, 970, 970};
  IvCurve warm = UpAndDown();
  warm.temperature_C = {25, 25, 25, 26.5, 26.5, 26.5};
  for (IvCurve* curve : {&bright, &warm}) {
    const auto selected = SelectSweep({}, false, curve);
    ASSERT_FALSE(selected);
    EXPECT_THAT(selected.error().message, HasSubstr("at different irradiance or temperature"));
    EXPECT_THAT(selected.error().message, HasSubstr("--curve INDEX"));
  }
  IvCurve about_equal = UpAndDown();
  about_equal.irradiance_W_m2 = {1000, 1000, 1000, 990, 990, 990};
  about_equal.temperature_C = {25, 25, 25, 25.5, 25.5, 25.5};
  EXPECT_TRUE(SelectSweep({}, false, &about_equal));
  IvCurve dark = UpAndDown();
  dark.irradiance_W_m2.assign(6, 0);
  EXPECT_TRUE(SelectSweep({}, false, &dark));
}

TEST(SelectSweepTest, SweepsInOneDirectionNeedAWish) {
  IvCurve curve = UpAndDown();
  curve.voltage_V = {0, 0.3, 0.6, 0, 0.3, 0.6};
  EXPECT_THAT(MessageOf(SelectSweep({}, false, &curve)),
              HasSubstr("2 sweeps in the same direction (0, 1)"));
}

TEST(SelectSweepTest, NumberedCurvesAlwaysNeedAWish) {
  IvCurve curve = UpAndDown();
  EXPECT_THAT(MessageOf(SelectSweep({}, true, &curve)), HasSubstr("found 2 curves"));
}

TEST(SelectSweepTest, WishThatCannotBeMetSaysWhatThereIs) {
  IvCurve curve = UpAndDown();
  const auto missing = SelectSweep(7, false, &curve);
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().message, HasSubstr("curve 7 was asked for"));
  EXPECT_THAT(missing.error().message, HasSubstr("0, 1"));
  curve.sweep.clear();
  EXPECT_THAT(MessageOf(SelectSweep(7, false, &curve)), HasSubstr("no column sweep or curve"));
}

}  // namespace
}  // namespace lyrefit
