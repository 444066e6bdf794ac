#include "lyrefit/certify/branch.h"

#include <gtest/gtest.h>

#include "certify/made.h"
#include "lyrefit/certify/relaxation.h"
#include "repeats.h"

namespace lyrefit {
namespace {

BranchLimits LimitsOf(const MixtureData& data) {
  BranchLimits limits;
  limits.rs_upper = data.reference_voltage_V / data.current_A.maxCoeff();
  return limits;
}

// The measured-current problem, with any number of diodes.
BranchEnd BranchOverResistance(const MixtureData& data, const Window& window,
                               const BranchLimits& limits) {
  return BranchOver(MeasuredRelaxation(data, limits.rigorous), window, 0, kInfinity, limits);
}

BranchEnd BranchOverDiodes(const MixtureData& data, const Window& window, int diodes, double primal,
                           const BranchLimits& limits) {
  return BranchOver(MeasuredRelaxation(data, limits.rigorous), window, diodes, primal, limits);
}

TEST(BranchOverResistance, BoundsEveryResistanceAndAttainsTheBest) {
  for (std::uint64_t seed = 100; seed < 110; ++seed) {
    const IvCurve curve = RandomCurve(seed);
    const MixtureData data = DataOf(curve);
    const Window window = WindowOf(curve, 1, 2);
    const BranchLimits limits = LimitsOf(data);
    const BranchEnd end = BranchOverResistance(data, window, limits);
    EXPECT_TRUE(end.complete) << curve.name;
    EXPECT_GE(end.lower, end.best.primal * (1 - 2e-10)) << curve.name;
    double lowest = end.best.primal;
    for (int i = 0; i <= 200; ++i) {
      const double rs = 0.2 * limits.rs_upper * i / 200;
      lowest = std::min(lowest, SolveMixture(data, {window}, rs, {}, 1e-10, 20).primal);
    }
    EXPECT_GE(lowest, end.lower * (1 - 1e-12)) << curve.name;
  }
}

// A coarse tolerance leaves large infeasibility in the dual vectors of all mixtures, whose penalty
// must be included in full.
TEST(BranchOverResistance, HoldsWithCoarseMixturesToo) {
  for (int seed = 112; seed < 112 + Repeats(6); ++seed) {
    const IvCurve curve = RandomCurve(seed);
    const MixtureData data = DataOf(curve);
    const Window window = WindowOf(curve, 0.5, 4);
    BranchLimits limits = LimitsOf(data);
    const double lowest = BranchOverResistance(data, window, limits).best.primal;
    for (const double tolerance : {0.9, 0.3, 1e-2, 1e-4}) {
      limits.tolerance = tolerance;
      const BranchEnd coarse = BranchOverResistance(data, window, limits);
      EXPECT_LE(coarse.lower, lowest * (1 + 1e-9)) << curve.name;
      EXPECT_GE(coarse.lower, coarse.best.primal * (1 - tolerance)) << curve.name;
    }
  }
}

TEST(BranchOverDiodes, FindsTheBestSingleDiodeByItself) {
  const IvCurve curve = Shipped("rtc_france");
  const MixtureData data = DataOf(curve);
  const double certified = 0.5 * 26 * 9.860218778918e-4 * 9.860218778918e-4;
  const BranchEnd end =
      BranchOverDiodes(data, WindowOf(curve, 1, 2), 1, 2 * certified, LimitsOf(data));
  EXPECT_TRUE(end.complete);
  EXPECT_NEAR(end.best.primal / certified, 1, 1e-9);
  EXPECT_NEAR(end.lower / certified, 1, 1e-9);
  EXPECT_EQ(end.best.atoms.size(), 1U);
}

TEST(BranchOverDiodes, FindsTheBestTwoDiodesWhereTheFloorNeedsThree) {
  SKIP_IF_SANITIZED();
  const IvCurve curve = Shipped("msx60");
  const MixtureData data = DataOf(curve);
  const double certified = 0.5 * 15 * 2.216617042418e-5 * 2.216617042418e-5;
  const BranchEnd end =
      BranchOverDiodes(data, WindowOf(curve, 1, 2), 2, 1.5 * certified, LimitsOf(data));
  EXPECT_TRUE(end.complete);
  EXPECT_NEAR(end.best.primal / certified, 1, 1e-8);
  EXPECT_LE(end.lower, certified * (1 + 1e-9));
  EXPECT_GE(end.lower, end.best.primal * (1 - 1e-9));
}

TEST(BranchOverDiodes, StopsAtOnceWhereTheValueCannotBeReached) {
  const IvCurve curve = Shipped("rtc_france");
  const MixtureData data = DataOf(curve);
  const double below_floor = 0.5 * 26 * 9.7e-4 * 9.7e-4;
  const BranchEnd end =
      BranchOverDiodes(data, WindowOf(curve, 1, 2), 2, below_floor, LimitsOf(data));
  EXPECT_TRUE(end.complete);
  EXPECT_GE(end.lower, below_floor * (1 - 1e-9));
}

TEST(Branch, GivesUpWhenToldTo) {
  const IvCurve curve = Shipped("msx60");
  const MixtureData data = DataOf(curve);
  BranchLimits limits = LimitsOf(data);
  limits.most_solved = 12;
  const BranchEnd few = BranchOverResistance(data, WindowOf(curve, 1, 2), limits);
  EXPECT_FALSE(few.complete);
  EXPECT_LT(few.lower, few.best.primal);
  limits.most_solved = 100000;
  limits.stop = [](std::int64_t solved, double, double) { return solved >= 12; };
  const BranchEnd stopped = BranchOverResistance(data, WindowOf(curve, 1, 2), limits);
  EXPECT_FALSE(stopped.complete);
  EXPECT_LE(stopped.solved, 14);
}

}  // namespace
}  // namespace lyrefit
