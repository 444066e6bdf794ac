#include "lyrefit/diagnose/fitted_candidate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lyrefit/model/effects/catalogue.h"

namespace lyrefit {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Not;

FittedCandidate Of(double statistic, double charge, double freedom, int place) {
  FittedCandidate fitted;
  fitted.statistic = statistic;
  fitted.score.charge = charge;
  fitted.score.outlier = place;
  fitted.freedom = freedom;
  return fitted;
}

TEST(FittedCandidateTest, WhatIsPaidCountsAndEqualsKeepTheirOrder) {
  std::vector<FittedCandidate> fitted_candidates = {Of(10, 4, 0, 0), Of(30, 2, 25, 1),
                                                    Of(9, 3, 0, 2), Of(8, 0, 0, 3)};
  PutBestFirst(&fitted_candidates);
  std::vector<int> order;
  for (const FittedCandidate& fitted : fitted_candidates) order.push_back(fitted.score.outlier);
  EXPECT_THAT(order, ElementsAre(3, 0, 2, 1));
}

TEST(FittedCandidateTest, ThereIsNoRoomForWhatIsThereNorForWhatItExcludes) {
  const std::vector<const Effect*> all = Catalogue();
  Law law;
  EXPECT_EQ(RoomFor(law, all), all);
  const Effect* shading = FindEffect("shading");
  law.effects.push_back(shading);
  const std::vector<const Effect*> open = RoomFor(law, all);
  EXPECT_THAT(open, Not(Contains(shading)));
  EXPECT_THAT(open, Contains(FindEffect("irr_step")));
  for (const Effect* effect : all) {
    if (!Exclude(*shading, *effect)) continue;
    EXPECT_THAT(open, Not(Contains(effect))) << effect->id;
  }
}

}  // namespace
}  // namespace lyrefit
