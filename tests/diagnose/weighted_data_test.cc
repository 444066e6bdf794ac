#include "lyrefit/diagnose/weighted_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "synthetic_data.h"

namespace lyrefit {
namespace {

TEST(WhitenTest, DividesByTheNoiseAndDropsWhatIsLeftOut) {
  SyntheticData made = OnTheData(SyntheticCurve({}));
  made.weighted.used[4] = 0;
  const double sigma = made.weighted.sigma.front();
  const Eigen::VectorXd white =
      Whiten(made.weighted, Eigen::VectorXd::Constant(made.weighted.used.size(), 2));
  EXPECT_DOUBLE_EQ(white[0], 2 / sigma);
  EXPECT_EQ(white[4], 0);
  EXPECT_EQ(made.weighted.count(), 59);
}

// First-order autoregressive noise becomes white, separately within each chain.
TEST(WhitenTest, TakesTheCorrelationOut) {
  Recipe recipe;
  recipe.points = 1000;
  recipe.and_back = true;
  SyntheticData made = OnTheData(SyntheticCurve(recipe));
  constexpr double kRho = 0.7;
  made.weighted.correlation = kRho;
  const double sigma = made.weighted.sigma.front();
  RandomStream random(3);
  Eigen::VectorXd noise(2000);
  double last = random.Normal();
  for (int k = 0; k < 2000; ++k) {
    last = k == 1000 ? random.Normal() : kRho * last + std::sqrt(1 - kRho * kRho) * random.Normal();
    noise[k] = sigma * last;
  }
  const Eigen::VectorXd white = Whiten(made.weighted, noise);
  EXPECT_NEAR(white.squaredNorm() / 2000, 1, 0.12);
  EXPECT_NEAR(white.head(1999).dot(white.tail(1999)) / 2000, 0, 0.07);
}

TEST(WhitenTest, WhitensColumnsAsEachByItself) {
  SyntheticData made = OnTheData(SyntheticCurve({}));
  made.weighted.path = 1e-3;
  const int count = made.weighted.count();
  Eigen::MatrixXd columns(count, 2);
  for (int k = 0; k < count; ++k) columns.row(k) << std::cos(0.1 * k), k;
  const Eigen::MatrixXd white = WhitenColumns(made.weighted, columns);
  for (int c = 0; c < 2; ++c) {
    const Eigen::VectorXd column = columns.col(c);
    EXPECT_EQ(white.col(c), Whiten(made.weighted, column)) << c;
  }
}

TEST(FitBaseTest, FindsTheDevice) {
  for (const int cells : {1, 60}) {
    Recipe recipe;
    recipe.cells = cells;
    recipe.noise_A = 0;
    const SyntheticData made = OnTheData(SyntheticCurve(recipe));
    const LawFit fit = FitBase(made.weighted, Law());
    ASSERT_TRUE(fit.usable);
    EXPECT_NEAR(fit.p[kIph], 8, 1e-4);
    EXPECT_NEAR(Ideality(fit), 1.2, 1e-3);
    EXPECT_NEAR(fit.p[kRs] / cells, 0.004, 1e-5);
    EXPECT_NEAR(cells / fit.p[kRsh], 1 / 20., 1e-3);
    EXPECT_LT(fit.sum, 1e-3);
  }
}

TEST(FitBaseTest, SumIsThatOfNoise) {
  double sum = 0;
  for (int seed = 1; seed <= 20; ++seed) {
    Recipe recipe;
    recipe.seed = seed;
    const SyntheticData made = OnTheData(SyntheticCurve(recipe));
    const LawFit fit = FitBase(made.weighted, Law());
    double by_hand = 0;
    for (std::size_t k = 0; k < fit.current.size(); ++k) {
      by_hand += std::pow(
          (fit.current[k] - made.measurement.readings.points[k].current) / made.weighted.sigma[k],
          2);
    }
    EXPECT_NEAR(fit.sum, by_hand, 1e-6 * by_hand);
    sum += fit.sum / 55 / 20;  // 60 readings, 5 parameters
  }
  EXPECT_NEAR(sum, 1, 0.15);
}

TEST(FitLawTest, HoldsWhatIsSearched) {
  const SyntheticData made = OnTheData(SyntheticCurve({}));
  Law law;
  law.effects = {FindEffect("irr_step")};
  std::vector<double> start = FitBase(made.weighted, Law()).p;
  start.insert(start.end(), {0.0, 0.123});
  const LawFit fit = FitLaw(made.weighted, law, start);
  EXPECT_EQ(fit.p.back(), 0.123);
  EXPECT_EQ(FreeCount(made.weighted, law), 6);
}

TEST(FitLawTest, DarkCurvesHaveNoPhotocurrent) {
  const SyntheticData made = OnTheData(SyntheticDarkCurve());
  EXPECT_EQ(FreeCount(made.weighted, Law()), 4);
  const LawFit fit = FitBase(made.weighted, Law());
  ASSERT_TRUE(fit.usable);
  EXPECT_NEAR(Ideality(fit), 1.2, 0.02);
}

TEST(LinearizeTest, IsTheFitsTangent) {
  const SyntheticData made = OnTheData(SyntheticCurve({}));
  const LawFit fit = FitBase(made.weighted, Law());
  const Linearized linear = Linearize(made.weighted, fit);
  ASSERT_EQ(linear.free.size(), 5U);
  EXPECT_NEAR(linear.residual.squaredNorm(), fit.sum, 1e-9 * fit.sum);
  EXPECT_LT((linear.basis.transpose() * linear.basis - Eigen::MatrixXd::Identity(5, 5)).norm(),
            1e-10);
  // At an optimum the residual has no component along the parameters.
  EXPECT_LT((linear.basis.transpose() * linear.residual).norm(), 1e-3 * std::sqrt(fit.sum));
  const Eigen::MatrixXd rest =
      linear.jacobian - linear.basis * (linear.basis.transpose() * linear.jacobian);
  EXPECT_LT(rest.norm(), 1e-9 * linear.jacobian.norm());
}

TEST(LinearizeTest, ParametersPressedAgainstABoundAreNotFree) {
  IvCurve curve = SyntheticCurve({});
  for (std::size_t k = 0; k < curve.size(); ++k) curve.current_A[k] += 0.3 * curve.voltage_V[k];
  const SyntheticData made = OnTheData(curve);  // rises: 1/Rsh would be negative
  const LawFit fit = FitBase(made.weighted, Law());
  const Linearized linear = Linearize(made.weighted, fit);
  EXPECT_GT(fit.p[kRsh], 1e6);
  EXPECT_EQ(std::count(linear.free.begin(), linear.free.end(), kRsh), 0);
  EXPECT_EQ(StandardErrors(linear)[kRsh], 0);
}

// Standard errors equal the spread of fits over seeds.
TEST(StandardErrorsTest, AreTheSpreadOfRepeatedFits) {
  constexpr int kSeeds = 120;
  std::vector<double> sum(5, 0.0), square(5, 0.0), stated(5, 0.0);
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Recipe recipe;
    recipe.seed = seed;
    recipe.points = 120;
    const SyntheticData made = OnTheData(SyntheticCurve(recipe));
    const LawFit fit = FitBase(made.weighted, Law());
    const std::vector<double> errors = StandardErrors(Linearize(made.weighted, fit));
    for (int k = 0; k < 5; ++k) {
      const double p = fit.p[k];
      const bool bent = k == SaturationCurrentIndex(0) || k == kRsh;  // normal on other scales
      const double value = !bent ? p : k == kRsh ? 1 / p : std::log(p);
      const double slope = !bent ? 1 : k == kRsh ? 1 / (p * p) : 1 / p;
      sum[k] += value / kSeeds;
      square[k] += value * value / kSeeds;
      stated[k] += errors[k] * slope / kSeeds;
    }
  }
  for (int k = 0; k < 5; ++k) {
    const double spread = std::sqrt(square[k] - sum[k] * sum[k]);
    EXPECT_NEAR(stated[k] / spread, 1, 0.25) << k;
  }
}

}  // namespace
}  // namespace lyrefit
