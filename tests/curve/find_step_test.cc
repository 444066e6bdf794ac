#include "lyrefit/curve/beyond_voc.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lyrefit/base/random.h"
#include "synthetic/curves.h"

namespace lyrefit {
namespace {

TEST(FindStepTest, ABypassedSubstringIsAStepWhereItsFallEnds) {
  const auto half = FindStep(SyntheticModule(1, 1, 0.5));
  ASSERT_TRUE(half);
  EXPECT_NEAR(half->voltage_V, 25, 2);
  EXPECT_GT(half->depth_A, 1);
  const auto two = FindStep(SyntheticModule(1, 0.6, 0.6));
  ASSERT_TRUE(two);
  EXPECT_NEAR(two->voltage_V, 12, 2);
}

TEST(FindStepTest, SmoothCurvesHaveNone) {
  EXPECT_FALSE(FindStep(SyntheticModule()));
  EXPECT_FALSE(FindStep(SyntheticModule(1, 1, 1, 26)));
  EXPECT_FALSE(FindStep(SyntheticModule(1, 1, 1, 8)));
  EXPECT_FALSE(FindStep(SyntheticCell()));
  EXPECT_FALSE(FindStep(SyntheticCell(0)));
}

TEST(FindStepTest, NoiseAndSingleOutliersAreNone) {
  IvCurve curve = SyntheticModule();
  curve.current_A[40] -= 3;
  EXPECT_FALSE(FindStep(curve));
  RandomStream random(3);
  for (double& current : curve.current_A) current += 0.1 * random.Normal();
  EXPECT_FALSE(FindStep(curve));
}

TEST(FindStepTest, TheOrderOfTheReadingsDoesNotMatter) {
  IvCurve curve = SyntheticModule(1, 1, 0.5);
  const auto step = FindStep(curve);
  std::reverse(curve.voltage_V.begin(), curve.voltage_V.end());
  std::reverse(curve.current_A.begin(), curve.current_A.end());
  const auto reversed = FindStep(curve);
  ASSERT_TRUE(step && reversed);
  EXPECT_NEAR(step->voltage_V, reversed->voltage_V, 1e-9);
}

}  // namespace
}  // namespace lyrefit
