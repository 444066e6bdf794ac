#include "lyrefit/family/family_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "family/synthetic_family.h"
#include "lyrefit/estimate/refine/coordinates.h"

namespace lyrefit {
namespace {

double Total(const JointEnd& end) { return end.squares + end.prior_squares; }

double CostAt(const JointProblem& problem, const JointPoint& point) {
  const std::vector<bool> active(problem.shared(), true);
  const FamilyModel model(problem);
  return Linearize(model, model.Pack(point), active).residual.squaredNorm();
}

// A problem with all four combinations of local unknowns of a curve: irradiance free, temperature
// free, both with priors, none.
JointProblem WithLocals(JointProblem problem) {
  problem.curves[1].irradiance_sd = HUGE_VAL;
  problem.curves[2].temperature_sd_K = HUGE_VAL;
  problem.curves[3].irradiance_sd = 0.02;
  problem.curves[3].temperature_sd_K = 1.5;
  problem.noise_A = 2e-3;
  return problem;
}

struct LawCase {
  TranslationLaw law;
  Model model;
  bool recombination;
};

class EveryLaw : public testing::TestWithParam<LawCase> {
 protected:
  Translation law_ = SyntheticLaw(GetParam().law, GetParam().model, GetParam().recombination);
  std::vector<double> truth_ = SyntheticTruth(law_);
};

TEST_P(EveryLaw, LinearizeAgreesWithCentralDifferences) {
  for (const Objective objective : {Objective::kMeasuredCurrent, Objective::kSolvedCurrent}) {
    JointProblem problem =
        WithLocals(SyntheticProblem(SyntheticSet(law_, truth_, kSixPlaces, 9, 2e-3), law_, truth_));
    problem.objective = objective;
    for (int i = 0; i < problem.shared(); ++i) {  // fixed parameters need derivatives as well
      if (problem.lower[i] < problem.upper[i]) continue;
      problem.lower[i] = truth_[i] - 0.1 - 0.3 * std::fabs(truth_[i]);
      problem.upper[i] = truth_[i] + 0.1 + 0.3 * std::fabs(truth_[i]);
    }
    const FamilyModel model(problem);
    const std::vector<bool> none(problem.shared(), false);
    const FitPoint point{truth_, std::vector<double>(model.shape().locals(), 0.01)};
    const Coordinates coordinates(model.shape(), truth_, none);
    const std::vector<double> theta = coordinates.Start();
    const Linearization now = Linearize(model, point, none);
    const double* local = point.local.data();
    for (int c = 0; c < 4; ++c) {
      const FitBlock& block = model.shape().blocks[c];
      const RowMatrix shared = now.jacobian.middleRows(now.first_row[c], block.residuals);
      const auto differ = [&](bool is_shared, int k, double largest, const RowMatrix& jacobian) {
        const std::vector<double> own(local, local + block.locals);
        std::vector<double> moved = is_shared ? theta : own;
        std::vector<double> up(block.residuals), down(up);
        const double step = 1e-5 * (1 + std::fabs(moved[k])), middle = moved[k];
        const auto evaluate = [&](double x, std::vector<double>* out) {
          moved[k] = x;
          return EvaluateBlock(model, coordinates, c, is_shared ? moved.data() : theta.data(),
                               is_shared ? own.data() : moved.data(), 1, out->data(), nullptr,
                               nullptr);
        };
        ASSERT_TRUE(evaluate(middle + step, &up));
        ASSERT_TRUE(evaluate(middle - step, &down));
        for (int r = 0; r < block.residuals; ++r) {
          EXPECT_NEAR(jacobian(r, k), (up[r] - down[r]) / (2 * step), 1e-5 * largest)
              << ToText(objective) << " curve " << c << (is_shared ? " shared " : " local ") << k;
        }
      };
      for (int k = 0; k < coordinates.size(); ++k) {
        differ(true, k, shared.col(k).cwiseAbs().maxCoeff() + 1e-5, shared);
      }
      for (int k = 0; k < block.locals; ++k) {
        differ(false, k, now.local[c].col(k).cwiseAbs().maxCoeff(), now.local[c]);
      }
      local += block.locals;
    }
  }
}

TEST_P(EveryLaw, RefineJointlyRecoversAnExactFamilyFromAPoorStart) {
  const JointProblem problem =
      SyntheticProblem(SyntheticSet(law_, truth_, kSixPlaces, 25, 0), law_, truth_);
  std::vector<double> start = truth_;
  const auto set = [&](int i, double value) {
    if (i >= 0 && problem.lower[i] < problem.upper[i]) start[i] = value;
  };
  set(law_.photocurrent, 3.0);
  set(law_.saturation_current, 30 * start[law_.saturation_current]);
  set(law_.n, 1.45);
  set(law_.resistance_series, 0.1);
  set(law_.resistance_shunt, 60);
  set(law_.alpha_sc, 0);
  set(law_.bandgap, 1.2);
  set(law_.n_slope, 0);
  set(law_.resistance_shunt_dark, 500);
  set(law_.saturation_current_2, 1e-6);
  set(law_.recombination, 0.3);
  const JointEnd end = RefineJointly(problem, PointAt(problem, start));
  for (int i = 0; i < law_.size(); ++i) {
    EXPECT_NEAR(end.point.shared[i] / truth_[i], 1, 1e-8) << law_.parameters[i].name;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Joint, EveryLaw,
    testing::Values(LawCase{TranslationLaw::kDeSoto, Model::kSingleDiode, false},
                    LawCase{TranslationLaw::kDeSoto, Model::kDoubleDiode, false},
                    LawCase{TranslationLaw::kPvsyst, Model::kSingleDiode, false},
                    LawCase{TranslationLaw::kPvsyst, Model::kDoubleDiode, true}),
    [](const testing::TestParamInfo<LawCase>& test) {
      return ToText(test.param.law) + "_" + ToText(test.param.model);
    });

class RefineJointlyTest : public testing::Test {
 protected:
  JointProblem Problem(std::uint64_t seed) const {
    return SyntheticProblem(SyntheticSet(law_, truth_, kSixPlaces, 15, 2e-3, seed), law_, truth_);
  }
  const Translation law_ = SyntheticLaw(TranslationLaw::kDeSoto);
  std::vector<double> truth_ = SyntheticTruth(law_);
};

TEST_F(RefineJointlyTest, EndsAtTheBestPointSoFarWhenAskedTo) {
  const JointProblem problem = Problem(1);
  std::vector<double> start = truth_;
  start[law_.saturation_current] *= 30;
  start[law_.n] = 1.45;
  const double best = Total(RefineJointly(problem, PointAt(problem, start)));
  double before = HUGE_VAL;
  for (const int steps : {0, 1, 2}) {
    JointOptions options;
    int asked = 0;
    options.stop = StopToken([&] { return asked++ >= steps; });
    const JointEnd end = RefineJointly(problem, PointAt(problem, start), options);
    EXPECT_TRUE(end.stopped);
    EXPECT_FALSE(end.converged);
    EXPECT_EQ(asked, steps + 1) << "not asked again";
    EXPECT_LE(Total(end), before);
    EXPECT_GT(Total(end), best * 1.001);
    before = Total(end);
  }
  EXPECT_FALSE(RefineJointly(problem, PointAt(problem, start)).stopped);
}

TEST_F(RefineJointlyTest, EndsWhereNoUnknownCanBeMovedDownhill) {
  const JointProblem problem = WithLocals(Problem(1));
  const JointEnd end = RefineJointly(problem, PointAt(problem, truth_));
  EXPECT_LT(end.projected_gradient, 1e-7);
  EXPECT_TRUE(end.converged);
  EXPECT_NEAR(CostAt(problem, end.point), Total(end), 1e-12 * Total(end));
  EXPECT_GT(end.prior_squares, 0);
  const FamilyModel model(problem);
  const Linearization now = Linearize(model, model.Pack(end.point), end.active);
  for (std::size_t c = 0; c < now.local.size(); ++c) {
    const auto residual = now.residual.segment(now.first_row[c], now.local[c].rows());
    for (int k = 0; k < now.local[c].cols(); ++k) {
      const double cosine =
          now.local[c].col(k).dot(residual) / (now.local[c].col(k).norm() * now.residual.norm());
      EXPECT_LT(std::fabs(cosine), 1e-7) << c;
    }
  }
  for (int i = 0; i < problem.shared(); ++i) {
    if (end.active[i]) continue;
    for (const double step : {1e-3, -1e-3}) {
      JointPoint moved = end.point;
      moved.shared[i] *= 1 + step;
      EXPECT_GT(CostAt(problem, moved), Total(end)) << i;
    }
  }
  for (const auto& [c, which] : {std::pair(1, 0), {2, 1}, {3, 0}, {3, 1}}) {
    for (const double step : {1e-3, -1e-3}) {
      JointPoint moved = end.point;
      moved.local[c][which] += step;
      EXPECT_GT(CostAt(problem, moved), Total(end)) << c << which;
    }
  }
}

TEST_F(RefineJointlyTest, FitsTheCurvesOwnUnknownsWhereEverythingSharedIsHeld) {
  JointProblem problem = Problem(1);
  problem.lower = problem.upper = truth_;
  problem.curves[1].irradiance_W_m2 = 900;
  problem.curves[1].irradiance_sd = HUGE_VAL;
  const JointEnd end = RefineJointly(problem, PointAt(problem, truth_));
  EXPECT_NEAR(900 * (1 + end.point.local[1][0]), 1000, 2);
}

TEST_F(RefineJointlyTest, HoldsAResistanceAtItsBoundAndOnlyWhereItPresses) {
  truth_[law_.resistance_series] = 0;
  truth_[law_.resistance_shunt] = 1e9;
  int at_zero = 0, perfect = 0;
  constexpr int kSeeds = 8;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const JointProblem problem = Problem(seed);
    std::vector<double> start = SyntheticTruth(law_);
    start[law_.resistance_shunt] = 3000;
    const JointEnd end = RefineJointly(problem, PointAt(problem, start));
    EXPECT_LT(end.projected_gradient, 1e-6) << seed;
    EXPECT_EQ(end.active[law_.resistance_series], end.point.shared[law_.resistance_series] == 0);
    EXPECT_EQ(end.active[law_.resistance_shunt], end.point.shared[law_.resistance_shunt] > 1e15)
        << end.point.shared[law_.resistance_shunt];
    at_zero += end.active[law_.resistance_series];
    perfect += end.active[law_.resistance_shunt];
  }
  EXPECT_GT(at_zero, 0);
  EXPECT_LT(at_zero, kSeeds);
  EXPECT_GT(perfect, 0);
  EXPECT_LT(perfect, kSeeds);
}

TEST_F(RefineJointlyTest, FindsThatThereIsNoSecondDiode) {
  const Translation two = SyntheticLaw(TranslationLaw::kDeSoto, Model::kDoubleDiode);
  std::vector<double> shared = SyntheticTruth(two);
  shared[two.saturation_current] = 2e-8;
  shared[two.n] = 1.2;
  shared[two.saturation_current_2] = 1e-6;
  int absent = 0;
  constexpr int kSeeds = 8;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const CurveSet set = SyntheticSet(law_, truth_, kSixPlaces, 15, 2e-3, seed);
    const JointProblem problem = SyntheticProblem(set, two, shared);
    const JointEnd end = RefineJointly(problem, PointAt(problem, shared));
    EXPECT_LT(end.projected_gradient, 1e-6) << seed;
    const JointProblem one = SyntheticProblem(set, law_, truth_);
    const double alone = Total(RefineJointly(one, PointAt(one, truth_)));
    EXPECT_LT(Total(end), alone * (1 + 1e-9)) << seed;
    if (!end.active[two.saturation_current_2]) continue;
    ++absent;
    EXPECT_NEAR(Total(end) / alone, 1, 1e-6);
  }
  EXPECT_GT(absent, 0);
  EXPECT_LT(absent, kSeeds);
}

TEST_F(RefineJointlyTest, HoldsTheDarkShuntAtTheEndOfItsRange) {
  const Translation law = SyntheticLaw(TranslationLaw::kPvsyst);
  std::vector<double> shared = SyntheticTruth(law);
  shared[law.resistance_shunt_dark] = shared[law.resistance_shunt];
  int at_bound = 0;
  constexpr int kSeeds = 6;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const JointProblem problem =
        SyntheticProblem(SyntheticSet(law, shared, kSixPlaces, 15, 2e-3, seed), law, shared);
    const JointEnd end = RefineJointly(problem, PointAt(problem, SyntheticTruth(law)));
    EXPECT_LT(end.projected_gradient, 1e-6) << seed;
    const double ratio =
        end.point.shared[law.resistance_shunt_dark] / end.point.shared[law.resistance_shunt];
    EXPECT_GE(ratio, 1 - 1e-12);
    EXPECT_EQ(end.active[law.resistance_shunt_dark], ratio < 1 + 1e-9) << seed << " " << ratio;
    at_bound += end.active[law.resistance_shunt_dark];
  }
  EXPECT_GT(at_bound, 0);
  EXPECT_LT(at_bound, kSeeds);
}

TEST_F(RefineJointlyTest, LetsGoWhatBeginsAtABoundAndWantsBack) {
  const Translation two = SyntheticLaw(TranslationLaw::kDeSoto, Model::kDoubleDiode);
  const std::vector<double> shared = SyntheticTruth(two);
  const JointProblem problem =
      SyntheticProblem(SyntheticSet(two, shared, kSixPlaces, 25, 1e-3), two, shared);
  const JointEnd best = RefineJointly(problem, PointAt(problem, shared));
  std::vector<double> start = shared;
  start[two.resistance_series] = 0;
  start[two.resistance_shunt] = HUGE_VAL;
  start[two.saturation_current] = 2e-8;
  start[two.n] = 1.2;
  start[two.saturation_current_2] = 0;
  const JointEnd end = RefineJointly(problem, PointAt(problem, start));
  EXPECT_NEAR(Total(end) / Total(best), 1, 1e-7);
  for (int i = 0; i < two.size(); ++i) {
    EXPECT_NEAR(end.point.shared[i] / best.point.shared[i], 1, 1e-4) << two.parameters[i].name;
  }
}

TEST_F(RefineJointlyTest, ComesBackFromAStartThatIsNoPlaceToBe) {
  JointProblem problem = Problem(1);
  problem.curves[0].irradiance_W_m2 = 1000;
  problem.lower[problem.temperature_offset()] = problem.upper[problem.temperature_offset()] = 500;
  const JointEnd end = RefineJointly(problem, PointAt(problem, truth_));
  EXPECT_FALSE(std::isfinite(Total(end)));
  const JointSpread spread = FindJointSpread(problem, end, 1);
  EXPECT_TRUE(std::isnan(spread.standard_error[law_.n]));
}

}  // namespace
}  // namespace lyrefit
