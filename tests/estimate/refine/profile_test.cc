#include "lyrefit/estimate/refine/profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "estimate/refine/test_curves.h"
#include "family/synthetic_family.h"
#include "lyrefit/estimate/refine/refine.h"
#include "lyrefit/estimate/refine/separable.h"
#include "lyrefit/family/family_model.h"
#include "lyrefit/family/joint.h"

namespace lyrefit {
namespace {

// One residual: x, or (x - 1/2) / 2 where the second parameter is 1. The second parameter has no
// derivative, so that a descent stays at its value.
class TwoOptima : public FitModel {
 public:
  TwoOptima() : FitModel(Shape()) {}

  bool Evaluate(int /*block*/, const double* p, const double* /*local*/, double* residuals,
                double* slopes, double* /*local_slopes*/) const override {
    const bool other = p[1] > 0.5;
    residuals[0] = other ? (p[0] - 0.5) / 2 : p[0];
    if (slopes == nullptr) return true;
    slopes[0] = other ? 0.5 : 1;
    slopes[1] = 0;
    return true;
  }

 private:
  static ModelShape Shape() {
    ModelShape shape;
    shape.parameters.resize(2);
    shape.parameters[0].lower = -100;
    shape.parameters[0].upper = 100;
    shape.parameters[1].upper = 1;
    shape.blocks = {{1, 0}};
    return shape;
  }
};

TEST(FindProfileSide, ReachesOverTheOtherOptimaToo) {
  const TwoOptima model;
  ProfileRefits refits;
  refits.refit = [&](double value, FitPoint start, double, double) {
    start.p[0] = value;
    RefineEnd end;
    end.p = start.p;
    end.mean_square = model.MeanSquare(start);
    return end;
  };
  RefineEnd best;
  best.p = {0, 0};
  const auto limit = [&](bool upper, std::vector<FitPoint> local_optima) {
    const ProfileSide side =
        FindProfileSide(model, best, {0, upper, 2, 1, 0.5, false, std::move(local_optima)}, refits);
    EXPECT_TRUE(side.settled);
    return side.value;
  };
  EXPECT_NEAR(limit(false, {}), -2, 0.02);
  EXPECT_NEAR(limit(true, {}), 2, 0.02);
  EXPECT_NEAR(limit(false, {{{0.5, 1}, {}}}), -3.5, 0.03);
  EXPECT_NEAR(limit(true, {{{0.5, 1}, {}}}), 4.5, 0.03);
  // The interval extends to what the other optimum allows, across values that neither optimum
  // allows.
  best.p = {0.5, 1};
  EXPECT_NEAR(limit(false, {{{0, 0}, {}}}), -3.5, 0.03);
}

TEST(FindProfileSide, EndsWhereTheRefittedSumOfSquaresReachesItsThreshold) {
  const RefineProblem problem = ModuleProblem(Model::kSingleDiode, Model::kSingleDiode,
                                              kSingleTruth, 3e-3, Objective::kSolvedCurrent);
  const RefineEnd best = Refine(problem, kSingleTruth);
  const int degrees = 35;
  const double t = 2.03;
  const double variance = VarianceOf(problem, best, degrees);
  const Spread spread = SpreadOf(problem, best, degrees);
  for (int i = 0; i < 5; ++i) {
    for (const bool upper : {false, true}) {
      const ProfileSide side =
          FindProfileSide(problem, best, {i, upper, t, variance, spread.standard_error[i]});
      ASSERT_FALSE(side.at_bound) << i;
      EXPECT_TRUE(side.better.empty());
      EXPECT_EQ(side.value > best.p[i], upper);
      RefineProblem held = problem;
      held.lower[i] = held.upper[i] = side.value;
      const double risen = Refine(held, SeparableDescent(held, best.p)).mean_square;
      EXPECT_NEAR(std::sqrt((risen / best.mean_square - 1) * degrees), t, 0.01 * t) << i;
      // The model is nearly linear for this curve, so that the symmetric interval is close.
      EXPECT_NEAR(std::fabs(side.value - best.p[i]) / (t * spread.standard_error[i]), 1, 0.4) << i;
    }
  }
}

// With the diodes exchanged, each n would be as good at the other's value.
TEST(FindProfileSide, KeepsAlikeDiodesInTheirOrder) {
  const RefineProblem problem = ModuleProblem(Model::kDoubleDiode, Model::kDoubleDiode,
                                              kTwoDiodeTruth, 1e-4, Objective::kSolvedCurrent);
  const RefineEnd best = Refine(problem, kTwoDiodeTruth);
  ASSERT_LT(best.p[IdealityIndex(0)], best.p[IdealityIndex(1)]);
  const int degrees = 33;
  const Spread spread = SpreadOf(problem, best, degrees);
  for (const bool second : {false, true}) {
    const int i = IdealityIndex(second ? 1 : 0);
    const ProfileSide side = FindProfileSide(
        problem, best,
        {i, /*upper=*/!second, 2.03, VarianceOf(problem, best, degrees), spread.standard_error[i]});
    EXPECT_FALSE(side.at_bound);
    EXPECT_LT(std::fabs(side.value - best.p[i]), 6 * spread.standard_error[i]);
    EXPECT_TRUE(second ? side.value > best.p[IdealityIndex(0)]
                       : side.value < best.p[IdealityIndex(1)]);
  }
}

// One of two diodes may be absent: the second. The first, whose place it could take, keeps its n.
TEST(FindProfileSide, OfTwoDiodesTheLastMayBeAbsent) {
  const RefineProblem problem = ModuleProblem(Model::kSingleDiode, Model::kDoubleDiode,
                                              kSingleTruth, 3e-3, Objective::kSolvedCurrent);
  const RefineEnd best = RefineFrom(problem, {3.8, 1e-8, 1.15, 0.25, 300, 1e-7, 1.6});
  ASSERT_GT(best.p[SaturationCurrentIndex(0)], 0);
  const Spread spread = SpreadOf(problem, best, 33);
  const auto side = [&](int i, bool upper) {
    return FindProfileSide(
        problem, best, {i, upper, 2.03, VarianceOf(problem, best, 33), spread.standard_error[i]});
  };
  EXPECT_TRUE(side(SaturationCurrentIndex(1), false).at_bound);
  EXPECT_FALSE(side(IdealityIndex(0), true).at_bound);
}

TEST(FindProfileSide, StopsAtTheBoundWhereTheDataDoNotObject) {
  const RefineProblem problem = ModuleProblem(Model::kSingleDiode, Model::kDoubleDiode,
                                              kSingleTruth, 3e-3, Objective::kSolvedCurrent);
  const RefineEnd best = Refine(problem, {3.8, 2e-8, 1.2, 0.25, 300, 1e-9, 1.6});
  const ProfileSide low =
      FindProfileSide(problem, best, {5, false, 2.03, VarianceOf(problem, best, 33), 0});
  EXPECT_TRUE(low.at_bound);
  EXPECT_EQ(low.value, 0);
}

TEST(FindProfileSide, EndsOutsideWhenItIsStopped) {
  const RefineProblem problem = ModuleProblem(Model::kSingleDiode, Model::kSingleDiode,
                                              kSingleTruth, 3e-3, Objective::kSolvedCurrent);
  const RefineEnd best = Refine(problem, kSingleTruth);
  const ProfileQuery query = {kRs, true, 2.03, VarianceOf(problem, best, 35), 0};
  const ProfileSide whole = FindProfileSide(problem, best, query);
  EXPECT_TRUE(whole.settled);
  const ProfileSide stopped = FindProfileSide(problem, best, query, StopToken([] { return true; }));
  EXPECT_FALSE(stopped.settled);
  EXPECT_GE(stopped.value, whole.value);
}

// The start is no optimum, and every refit has a lower sum of squares. The interval must reach
// beyond all refits.
TEST(FindProfileSide, IsNeverNarrowerThanWhatItSaw) {
  const RefineProblem problem = ModuleProblem(Model::kSingleDiode, Model::kSingleDiode,
                                              kSingleTruth, 3e-3, Objective::kSolvedCurrent);
  RefineEnd wrong = Refine(problem, kSingleTruth);
  wrong.mean_square *= 3;
  for (const bool upper : {false, true}) {
    const ProfileSide side =
        FindProfileSide(problem, wrong, {kIph, upper, 2.03, VarianceOf(problem, wrong, 35), 0});
    EXPECT_FALSE(side.better.empty());
    EXPECT_GT(std::fabs(side.value - wrong.p[kIph]), 1e-3);
    EXPECT_EQ(side.value > wrong.p[kIph], upper);
  }
}

ProfileSide SideOf(const JointProblem& problem, const JointEnd& best, const ProfileQuery& query) {
  return FindProfileSide(FamilyModel(problem), PackedEnd(problem, best), query, HowToRefine({}));
}

TEST(FindFamilyProfileSide, EndsWhereTheRefittedSumOfSquaresReachesItsThreshold) {
  const Translation law = SyntheticLaw(TranslationLaw::kDeSoto);
  const std::vector<double> truth = SyntheticTruth(law);
  JointProblem problem =
      SyntheticProblem(SyntheticSet(law, truth, kSixPlaces, 12, 3e-3), law, truth);
  problem.curves[1].irradiance_sd = HUGE_VAL;
  const JointEnd best = RefineJointly(problem, PointAt(problem, truth));
  const double variance = 9e-6, t = 2;
  const JointSpread spread = FindJointSpread(problem, best, variance);
  const auto rise = [&](int i, double value) {
    JointProblem held = problem;
    held.lower[i] = held.upper[i] = value;
    const JointEnd end = RefineJointly(held, best.point);
    return std::sqrt((end.squares - best.squares) / variance);
  };
  for (int i = 0; i < law.size(); ++i) {
    if (best.active[i]) continue;
    for (const bool upper : {false, true}) {
      const ProfileSide side =
          SideOf(problem, best, {i, upper, t, variance, spread.standard_error[i]});
      EXPECT_EQ(side.value > best.point.shared[i], upper) << law.parameters[i].name;
      EXPECT_FALSE(side.at_bound) << law.parameters[i].name;
      EXPECT_NEAR(rise(i, side.value), t, 0.01 * t) << law.parameters[i].name;
      // The threshold is not crossed before the end of the interval.
      const double middle = 0.5 * (side.value + best.point.shared[i]);
      EXPECT_LT(rise(i, middle), t) << law.parameters[i].name;
    }
  }
}

TEST(FindFamilyProfileSide, StopsAtABoundThatTheDataAllow) {
  const Translation law = SyntheticLaw(TranslationLaw::kDeSoto);
  std::vector<double> truth = SyntheticTruth(law);
  truth[law.resistance_series] = 0;
  truth[law.resistance_shunt] = 1e7;
  const JointProblem problem =
      SyntheticProblem(SyntheticSet(law, truth, kSixPlaces, 12, 3e-3), law, truth);
  const JointEnd best = RefineJointly(problem, PointAt(problem, truth));
  const ProfileSide low = SideOf(problem, best, {law.resistance_series, false, 2, 9e-6, 0});
  EXPECT_TRUE(low.at_bound);
  EXPECT_EQ(low.value, 0);
  EXPECT_TRUE(SideOf(problem, best, {law.resistance_shunt, true, 2, 9e-6, 0}).at_bound);
  const ProfileSide limit = SideOf(problem, best, {law.resistance_shunt, false, 2, 9e-6, 0});
  EXPECT_FALSE(limit.at_bound);
  EXPECT_GT(limit.value, 300);
}

}  // namespace
}  // namespace lyrefit
