#include "lyrefit/family/family_members.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Conditions At(double irradiance_W_m2, double temperature_C) {
  Conditions conditions;
  conditions.irradiance_W_m2 = irradiance_W_m2;
  conditions.cell_temperature_K = temperature_C + 273.15;
  return conditions;
}

TEST(CurveSubset, BeginsAtTheReferenceAndTakesTheFarthestNext) {
  const std::vector<Conditions> line = {At(100, 25), At(990, 25), At(900, 26), At(300, 25),
                                        At(1000, 80)};
  EXPECT_THAT(CurveSubset(line, {0, 1, 2, 3, 4}, 1), ElementsAre(1));
  EXPECT_THAT(CurveSubset(line, {0, 1, 2, 3, 4}, 2), ElementsAre(0, 1));
  EXPECT_THAT(CurveSubset(line, {0, 1, 2, 3, 4}, 3), ElementsAre(0, 1, 4));
  EXPECT_THAT(CurveSubset(line, {0, 1, 2, 3, 4}, 4), ElementsAre(0, 1, 3, 4));
}

TEST(CurveSubset, TakesOnlyFromThoseItIsGiven) {
  const std::vector<Conditions> line = {At(1000, 25), At(500, 25), At(490, 25), At(100, 25)};
  EXPECT_THAT(CurveSubset(line, {1, 2, 3}, 2), ElementsAre(1, 3));
  EXPECT_THAT(CurveSubset(line, {1, 3}, 5), ElementsAre(1, 3));
  EXPECT_THAT(CurveSubset(line, {1, 2, 3}, 0), IsEmpty());
  EXPECT_THAT(CurveSubset(line, {}, 3), IsEmpty());
}

TEST(CurveSubset, TakesNoneTwiceWhereAllAreAlike) {
  const std::vector<Conditions> same(5, At(700, 40));
  EXPECT_THAT(CurveSubset(same, {0, 1, 2, 3, 4}, 4), ElementsAre(0, 1, 2, 3));
}

TEST(CurveSubset, BearsDarkness) {
  const std::vector<Conditions> dark = {At(0, 25), At(1000, 25), At(500, 25)};
  EXPECT_THAT(CurveSubset(dark, {0, 1, 2}, 2), ElementsAre(0, 1));
}

}  // namespace
}  // namespace lyrefit
