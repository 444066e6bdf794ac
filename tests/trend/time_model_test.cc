#include "lyrefit/trend/time_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/base/random.h"
#include "repeats.h"
#include "trend/drawn_series.h"

namespace lyrefit {
namespace {

// Of `draws` series with a rate of 2 a year: in how many the 95 % interval of the rate holds it.
int RatesHeld(const NoiseModel& noise, int draws) {
  int held = 0;
  for (int draw = 0; draw < draws; ++draw) {
    TimeSeries series = DrawErrors(noise, DaysWithGaps(200), 100 + draw);
    for (std::size_t i = 0; i < series.days.size(); ++i) {
      series.values[i] += 5 + 2 * series.days[i] / 365.25;
    }
    const TimeFit fit = FitTime(series, LineDesign(series));
    const double half = fit.t_95() * std::sqrt(fit.covariance(1, 1));
    held += std::fabs(fit.coefficients[1] - 2) <= half ? 1 : 0;
  }
  return held;
}

// 0.95 within three standard deviations of a share of 300.
void ExpectAboutAllButFivePercent(int held, int draws) {
  const double sigma = std::sqrt(0.95 * 0.05 / draws);
  EXPECT_GT(held, (0.95 - 3 * sigma) * draws);
  EXPECT_LE(held, std::min(0.95 + 3.2 * sigma, 1.0) * draws);
}

TEST(FitTime, IntervalsHoldTheRateUnderIndependentErrors) {
  const int draws = Repeats(300);
  ExpectAboutAllButFivePercent(RatesHeld({0.3, 0, 0}, draws), draws);
}

TEST(FitTime, IntervalsHoldTheRateUnderErrorsThatDaysShare) {
  const int draws = Repeats(300);
  ExpectAboutAllButFivePercent(RatesHeld({0.3, 0.3, 6}, draws), draws);
}

TEST(FitTime, FindsTheSizesOfTheErrors) {
  double sigma = 0, shared = 0, shared_alone = 0;
  const int draws = Repeats(40);
  for (int draw = 0; draw < draws; ++draw) {
    const TimeSeries white = DrawErrors({0.3, 0, 0}, DaysWithGaps(300), draw);
    const TimeSeries both = DrawErrors({0.3, 0.6, 10}, DaysWithGaps(300), draw);
    const NoiseModel of_white = FitTime(white, LineDesign(white)).noise;
    const NoiseModel of_both = FitTime(both, LineDesign(both)).noise;
    sigma += of_white.sigma / draws;
    shared_alone += of_white.shared_sigma / draws;
    shared += of_both.shared_sigma / draws;
  }
  EXPECT_NEAR(sigma, 0.3, 0.03);
  EXPECT_LT(shared_alone, 0.06);
  EXPECT_NEAR(shared, 0.6, 0.15);
}

TEST(FitTime, OutliersDoNotSteerIt) {
  TimeSeries series = DrawErrors({0.1, 0, 0}, DaysWithGaps(200), 7);
  for (std::size_t i = 0; i < series.days.size(); ++i) {
    series.values[i] += 5 + 2 * series.days[i] / 365.25;
  }
  const TimeFit clean = FitTime(series, LineDesign(series));
  for (std::size_t i = series.days.size() - 40; i < series.days.size(); i += 8) {
    series.values[i] += 50;  // 500 standard deviations, all at the end
  }
  const TimeFit soiled = FitTime(series, LineDesign(series));
  const double half = clean.t_95() * std::sqrt(clean.covariance(1, 1));
  EXPECT_NEAR(soiled.coefficients[1], clean.coefficients[1], half);
  EXPECT_NEAR(soiled.noise.sigma, clean.noise.sigma, 0.5 * clean.noise.sigma);
  EXPECT_GT(soiled.spread[series.days.size() - 40], 1000);
  EXPECT_LT(soiled.usual_spread[series.days.size() - 40], 40);
}

TEST(FitTime, DaysOfFewMeasurementsCountLess) {
  RandomStream random(5);
  TimeSeries series = DrawErrors({0, 0, 0}, DaysWithGaps(300), 0);
  for (std::size_t i = 0; i < series.days.size(); ++i) {
    series.counts[i] = i % 3 == 0 ? 1 : 30;
    series.values[i] = random.Normal() / std::sqrt(series.counts[i]);
  }
  const TimeFit fit = FitTime(series, LineDesign(series));
  EXPECT_GT(fit.spread[0], 5 * fit.spread[1]);
}

TEST(FitTime, IsExactWithoutErrors) {
  TimeSeries series = DrawErrors({0, 0, 0}, DaysWithGaps(60), 0);
  for (std::size_t i = 0; i < series.days.size(); ++i) {
    series.values[i] = 5 + 2 * series.days[i] / 365.25;
  }
  const TimeFit fit = FitTime(series, LineDesign(series));
  EXPECT_NEAR(fit.coefficients[0], 5, 1e-12);
  EXPECT_NEAR(fit.coefficients[1], 2, 1e-11);
  EXPECT_TRUE(fit.covariance.allFinite());
}

// Sixty days of unlike spread.
TimeSeries UnlikeDays(const NoiseModel& noise) {
  TimeSeries series = DrawErrors(noise, DaysWithGaps(60), 0);
  series.spread.assign(series.days.size(), 1);
  for (std::size_t i = 0; i < series.spread.size(); i += 4) series.spread[i] = 3;
  return series;
}

// The covariance of the errors by its definition.
Eigen::MatrixXd CovarianceOf(const NoiseModel& noise, const TimeSeries& series) {
  const auto n = static_cast<Eigen::Index>(series.days.size());
  Eigen::MatrixXd covariance(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const double apart = std::fabs(series.days[i] - series.days[j]);
      covariance(i, j) = std::pow(noise.shared_sigma, 2) * std::exp2(-apart / noise.half_life_days);
    }
    covariance(i, i) += std::pow(noise.sigma, 2) * series.spread[i];
  }
  return covariance;
}

TEST(ErrorFilter, MakesIndependentColumnsOfTheErrorsItIsTold) {
  const NoiseModel noise = {0.3, 0.7, 5};
  const TimeSeries series = UnlikeDays(noise);
  const auto n = static_cast<Eigen::Index>(series.days.size());
  const ErrorFilter filter(noise, series);
  const Eigen::MatrixXd white = filter.Whiten(Eigen::MatrixXd::Identity(n, n));
  const Eigen::MatrixXd left =
      white * CovarianceOf(noise, series) * white.transpose() / (noise.sigma * noise.sigma);
  EXPECT_LT((left - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_NEAR(filter.log_determinant(), -2 * std::log(white.diagonal().prod()), 1e-9);
  const Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(n, -1, 3);
  EXPECT_LT((filter.WhitenBack(values) - white.transpose() * values).cwiseAbs().maxCoeff(), 1e-12);
  Eigen::VectorXd late = values;
  late.head(20).setZero();
  EXPECT_NEAR(filter.SquaredNorm(20, [&](Eigen::Index i) { return values[i]; }),
              (white * late).squaredNorm(), 1e-10);
}

TEST(ErrorVariance, IsThatOfTheWeightedSum) {
  const NoiseModel noise = {0.3, 0.8, 5};
  const TimeSeries series = UnlikeDays(noise);
  std::vector<double> weights(series.days.size());
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = std::sin(1.0 + i);
  const Eigen::Map<const Eigen::VectorXd> w(weights.data(),
                                            static_cast<Eigen::Index>(weights.size()));
  EXPECT_NEAR(ErrorVariance(noise, series, weights), w.dot(CovarianceOf(noise, series) * w), 1e-12);
  double alone = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    alone += 0.09 * series.spread[i] * weights[i] * weights[i];
  }
  EXPECT_NEAR(ErrorVariance({0.3, 0.8, 0}, series, weights), alone, 1e-12);
}

}  // namespace
}  // namespace lyrefit
