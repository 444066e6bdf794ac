#include "lyrefit/estimate/refine/drop_diode.h"

#include <gtest/gtest.h>

#include "estimate/refine/test_curves.h"
#include "lyrefit/estimate/refine/refine.h"

namespace lyrefit {
namespace {

RefineProblem Problem(Model truth, int points = 40) {
  return ModuleProblem(truth, Model::kDoubleDiode,
                       truth == Model::kDoubleDiode ? kTwoDiodeTruth : kSingleTruth, 1e-4,
                       Objective::kSolvedCurrent, 1, points);
}

TEST(RemoveFaded, TakesOutADiodeThatShowsNowhereWithItsIdeality) {
  const RefineProblem problem = Problem(Model::kDoubleDiode);
  const CurveModel model(problem);
  std::vector<bool> active(7, false);
  std::vector<double> p = kTwoDiodeTruth;
  EXPECT_FALSE(RemoveFaded(model.shape(), &p, &active));
  EXPECT_EQ(p, kTwoDiodeTruth);
  p[5] = 1e-15;
  EXPECT_TRUE(RemoveFaded(model.shape(), &p, &active));
  EXPECT_EQ(p[5], 0);
  EXPECT_EQ(active, (std::vector<bool>{false, false, false, false, false, true, true}));
  EXPECT_FALSE(RemoveFaded(model.shape(), &p, &active)) << "once";
}

TEST(RemoveFaded, LeavesADiodeWhoseBoundIsAbove0) {
  RefineProblem problem = Problem(Model::kDoubleDiode);
  problem.lower[5] = 1e-20;
  const CurveModel model(problem);
  std::vector<bool> active(7, false);
  std::vector<double> p = kTwoDiodeTruth;
  p[5] = 1e-15;
  EXPECT_FALSE(RemoveFaded(model.shape(), &p, &active));
  EXPECT_EQ(p[5], 1e-15);
}

TEST(FindDiodeToAdd, FindsTheDiodeThatTheResidualsAskFor) {
  for (const int points : {40, 2000}) {  // 2000 points are coarsened
    const RefineProblem problem = Problem(Model::kDoubleDiode, points);
    const CurveModel model(problem);
    FitPoint without{kTwoDiodeTruth, {}};
    without.p[5] = 0;
    const auto coarse = model.Coarse();
    EXPECT_EQ(coarse != nullptr, points == 2000);
    const DiodeToAdd diode = FindDiodeToAdd(model, coarse.get(), without, 5);
    EXPECT_GT(diode.cosine, 0.9);
    EXPECT_NEAR(diode.n, kTwoDiodeTruth[6], 0.1);
    EXPECT_NEAR(diode.size / kTwoDiodeTruth[5], 1, 0.6);
  }
}

TEST(FindDiodeToAdd, FindsNoneWhereTheDiodesAreAllThere) {
  const RefineProblem problem = Problem(Model::kSingleDiode);
  const CurveModel model(problem);
  std::vector<double> p = kSingleTruth;
  p[kIph] *= 1.1;  // the current is too large everywhere, so that a diode reduces the residual
  p.insert(p.end(), {0, 1.5});
  EXPECT_GT(FindDiodeToAdd(model, nullptr, {p, {}}, 5).cosine, 0);
  p[kIph] *= 0.8;
  EXPECT_EQ(FindDiodeToAdd(model, nullptr, {p, {}}, 5).cosine, 0);
}

}  // namespace
}  // namespace lyrefit
