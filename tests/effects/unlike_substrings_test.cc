#include "lyrefit/effects/odd_cells.h"

#include <gtest/gtest.h>

#include "effects/synthetic_readings.h"

namespace lyrefit {
namespace {

// A curve of 96 cells with steps at these parts of the open-circuit voltage, of equal height.
CurveShape WithSteps(const std::vector<double>& places) {
  CurveShape shape;
  shape.open_circuit = 0.6;
  for (int k = 0; k <= 200; ++k) {
    double current = k < 195 ? 1 : 0.2 * (200 - k);
    for (const double place : places) current -= k > 200 * place && k < 195 ? 0.3 : 0;
    shape.current.push_back(current);
  }
  return shape;
}

DataTraits ThreeSubstrings(int cells) {
  DataTraits traits = SyntheticReadings(DataKind::kForward, 60).traits;
  traits.cells = cells;
  traits.substrings = 3;
  traits.bypass_known = true;
  return traits;
}

TEST(UnlikeSubstrings, AreThoseWhoseStepsAreAtQuarters) {
  const auto shares = UnlikeShares(WithSteps({0.2, 0.7}), ThreeSubstrings(96));
  ASSERT_EQ(shares.size(), 1U);
  EXPECT_EQ(shares[0], (ThreeShares{0.25, 0.5, 0.25}));
  const auto one_step = UnlikeShares(WithSteps({0.45}), ThreeSubstrings(96));
  EXPECT_EQ(one_step.size(), 2U);  // the large one is bright, or dark
}

TEST(UnlikeSubstrings, AreNotSoughtElsewhere) {
  EXPECT_TRUE(UnlikeShares(WithSteps({0.29, 0.62}), ThreeSubstrings(96)).empty());
  EXPECT_TRUE(UnlikeShares(WithSteps({0.2, 0.7}), ThreeSubstrings(54)).empty());
  DataTraits four = ThreeSubstrings(96);
  four.substrings = 4;
  EXPECT_TRUE(UnlikeShares(WithSteps({0.2, 0.7}), four).empty());
}

// Starts of the effects on such a curve have a share of a half.
TEST(UnlikeSubstrings, AreStartsOfShade) {
  const CurveShape shape = WithSteps({0.45});
  const DataTraits traits = ThreeSubstrings(96);
  const auto half = [&](const char* id, int parameter) {
    int count = 0;
    for (const ShapeStart& start : FindEffect(id)->starts(shape, traits, {})) {
      count += start.p[parameter] == 0.5 ? 1 : 0;
    }
    return count;
  };
  EXPECT_GT(half("shading", 1), 0);
  EXPECT_GT(half("substrings", 3), 0);
  EXPECT_GT(half("covered_edge", 9), 0);
}

}  // namespace
}  // namespace lyrefit
