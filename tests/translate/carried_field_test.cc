// Short version of translate_study. Stated uncertainties must hold on measured sweeps of two
// modules and on simulated devices that follow other laws. Intervals are 95 %; the bounds allow for
// the small number of sweeps.
#include "translate/carried.h"

#include <gtest/gtest.h>

#include "translate/measured_sets.h"
#include "translate/translation_simulators.h"

namespace shown {
namespace {

void ExpectHeld(const lyrefit::Expected<MeasuredSet>& set, double least, double most) {
  ASSERT_TRUE(set) << set.error().ToString();
  const std::vector<Sweep> sweeps = Steady(MakeReady(set->curves, set->options, 0));
  ASSERT_GT(sweeps.size(), 30U) << set->name;
  const auto all = CarryPairs(sweeps, ConditionsOf(LikeScatter(sweeps)), {300, 1, 0, {}});
  const Tally tally = TallyOf(all, std::nullopt, true);
  EXPECT_GT(tally.count, 250) << set->name;
  EXPECT_GT(tally.within, least) << set->name;
  EXPECT_LT(tally.within, most) << set->name;
  EXPECT_LT(tally.expanded, 0.04) << set->name;
}

TEST(CarryPairs, KeepsWithinTheStatedUncertaintyOnSandiasSweeps) {
  ExpectHeld(SandiaSet(LYREFIT_FIELD_DATA_DIR, 9), 0.92, 0.995);
}

TEST(CarryPairs, KeepsWithinTheStatedUncertaintyOnNistsSweeps) {
  ExpectHeld(NistSet(LYREFIT_FIELD_DATA_DIR, {"2015-07-20", 1.1}, 4), 0.86, 0.995);
}

TEST(CarryOne, KeepsWithinTheStatedUncertaintyOnOtherLaws) {
  for (const std::string& world : Worlds()) {
    int within = 0, count = 0;
    for (int i = 0; i < 20; ++i) {
      const SyntheticCase made = MakeReferenceSweeps(world, {}, 500 + i);
      lyrefit::TranslateOptions options = ReadyOptions(false);
      options.coefficients = made.coefficients;
      const std::vector<Sweep> ready = MakeReady({made.curve}, options, 1);
      ASSERT_EQ(ready.size(), 1U) << world << i;
      for (const Carried& row : CarryOne(ready[0], {}, made.stc, {0, 0, 0, 0})) {
        if (!row.recommended) continue;
        ++count;
        within += row.error <= row.expanded && -row.error <= row.expanded;
      }
    }
    EXPECT_EQ(count, 20) << world;
    EXPECT_GE(within, 17) << world;
  }
}

}  // namespace
}  // namespace shown
