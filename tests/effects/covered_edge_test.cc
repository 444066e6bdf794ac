#include <gtest/gtest.h>

#include "effects/brute_module.h"

namespace lyrefit {
namespace {

BruteSubstring Covered(double cells, double part, double light) {
  return {{{{cells * part, light, 0}, {cells * (1 - part), 1, 0}}}, true};
}

TEST(CoveredEdgeTest, IsTheSumOfItsCells) {
  ExpectBruteCurrents("covered_edge", {0.6, 0.2, 0.45, 0.1, 0.3, 0.15, 0, 0.1, 0.5, 0, 60}, 60,
                      {Covered(20, 0.2, 0.4), Covered(20, 0.1, 0.55), Covered(20, 0.15, 0.7)});
}

TEST(CoveredEdgeTest, HasALargeFirstSubstringAndASoftReverseLaw) {
  ExpectBruteCurrents("covered_edge", {0.5, 0.05, 0.3, 0.25, 0.4, 0.1, 0, 0.1, 0.45, 0.5, 5}, 60,
                      {Covered(30, 0.05, 0.5), Covered(15, 0.25, 0.7), Covered(15, 0.1, 0.6)},
                      [](BruteModule* module) {
                        module->bypass_voltage = 0.45;
                        module->soft_voltage = 5;
                      });
}

TEST(CoveredEdgeTest, NeedsTwoToFourSubstrings) {
  DataTraits traits = SyntheticReadings(DataKind::kForward, 60).traits;
  const Effect& effect = *FindEffect("covered_edge");
  EXPECT_FALSE(effect.WhyNot(traits));
  traits.bypass_known = true;
  traits.substrings = 5;
  EXPECT_TRUE(effect.WhyNot(traits));
}

}  // namespace
}  // namespace lyrefit
