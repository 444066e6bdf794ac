#include "lyrefit/model/effect.h"

#include <gtest/gtest.h>

namespace lyrefit {
namespace {

TEST(EffectParameterTest, SaysByNameWhatEachOfItsNumbersIs) {
  constexpr EffectParameter p = Parameter("a", "factor", "conductance of a cell")
                                    .Unit("S")
                                    .Between(-1, 3)
                                    .From(2)
                                    .Searched()
                                    .Times(1000)
                                    .CurrentPower(1)
                                    .CellsPower(-1)
                                    .RatePower(-2)
                                    .FixedByDefault()
                                    .Scatter(0.01)
                                    .BelowUpper()
                                    .AboveLower()
                                    .AbsentAt(0)
                                    .Only(Whole::kCount);
  EXPECT_STREQ(p.symbol, "a");
  EXPECT_STREQ(p.name, "factor");
  EXPECT_STREQ(p.doc, "conductance of a cell");
  EXPECT_STREQ(p.unit, "S");
  EXPECT_EQ(p.lower, -1);
  EXPECT_EQ(p.upper, 3);
  EXPECT_EQ(p.neutral, 2);
  EXPECT_TRUE(p.searched);
  EXPECT_EQ(p.factor, 1000);
  EXPECT_EQ(p.current, 1);
  EXPECT_EQ(p.cells, -1);
  EXPECT_EQ(p.rate, -2);
  EXPECT_TRUE(p.fixed_by_default);
  EXPECT_EQ(p.scatter, 0.01);
  EXPECT_TRUE(p.below_upper);
  EXPECT_TRUE(p.above_lower);
  EXPECT_EQ(p.absent_at, 0);
  EXPECT_EQ(p.whole, Whole::kCount);
}

TEST(EffectParameterTest, IsFreeAndThereUnlessSaid) {
  constexpr EffectParameter p = Parameter("d", "deficit", "of the light").Between(0, 0.9);
  EXPECT_STREQ(p.unit, "");
  EXPECT_EQ(p.neutral, 0);
  EXPECT_EQ(p.factor, 1);
  EXPECT_FALSE(p.searched || p.fixed_by_default || p.below_upper || p.above_lower);
  EXPECT_NE(p.absent_at, p.absent_at);
  EXPECT_EQ(p.whole, Whole::kNo);
}

}  // namespace
}  // namespace lyrefit
