#include "lyrefit/translate/key_point_noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/base/random.h"

namespace lyrefit {
namespace {

struct Smooth {
  std::vector<double> voltage_V, current_A;
};

Smooth MakeSmooth(int points) {
  Smooth curve;
  for (int i = 0; i < points; ++i) {
    const double v = 38.0 * i / (points - 1);
    curve.voltage_V.push_back(v);
    curve.current_A.push_back(8 - 1e-9 * std::expm1(v / 1.63));
  }
  return curve;
}

// Isc is the first reading (at 0 V), so its noise is that of one reading.
TEST(KeyPointNoise, OfIscIsThatOfTheReadingAtZeroVolt) {
  const Smooth curve = MakeSmooth(101);
  const std::vector<double> sigma(101, 0.016);
  const KeyPointNoise noise =
      EstimateKeyPointNoise(curve.voltage_V, curve.current_A, sigma, {}, 4000, 1);
  EXPECT_EQ(noise.failed, 0);
  EXPECT_NEAR(std::sqrt(noise.relative_covariance[0][0]), 0.002, 0.0001);
  EXPECT_NEAR(noise.relative_bias[0], 0, 0.0001);
  EXPECT_GT(noise.relative_bias[kMaxPowerOutput], 0) << "the highest of noisy readings is too high";
}

// The estimated variance equals that of simulated readings with new noise.
TEST(KeyPointNoise, IsWhatFreshReadingsScatterBy) {
  const Smooth curve = MakeSmooth(60);
  const std::vector<double> sigma(60, 0.02), sigma_V(60, 0.01);
  const KeyPointNoise noise =
      EstimateKeyPointNoise(curve.voltage_V, curve.current_A, sigma, sigma_V, 2000, 1);
  RandomStream random(99);
  double sum = 0, squares = 0;
  constexpr int kSweeps = 2000;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    Smooth read = curve;
    for (std::size_t i = 0; i < 60; ++i) {
      read.current_A[i] += 0.02 * random.Normal();
      read.voltage_V[i] += 0.01 * random.Normal();
    }
    const double power = FindKeyPoints(read.voltage_V, read.current_A).max_power_W;
    sum += power;
    squares += power * power;
  }
  const double mean = sum / kSweeps;
  const double scatter = std::sqrt(squares / kSweeps - mean * mean) / mean;
  EXPECT_NEAR(std::sqrt(noise.relative_covariance[4][4]) / scatter, 1, 0.07);
}

TEST(KeyPointNoise, MakesALineInProportionToTheResults) {
  const Smooth curve = MakeSmooth(101);
  const KeyPointNoise noise = EstimateKeyPointNoise(curve.voltage_V, curve.current_A,
                                                    std::vector<double>(101, 0.016), {}, 1000, 1);
  const std::vector<double> results = {10, 40, 9, 33, 297, 0.74};
  const OutputTerm term = NoiseTerm(noise, results);
  for (std::size_t k = 0; k < results.size(); ++k) {
    double variance = 0;
    for (const std::vector<double>& factor : term.factors) variance += factor[k] * factor[k];
    EXPECT_NEAR(std::sqrt(variance) / results[k], std::sqrt(noise.relative_covariance[k][k]), 1e-6);
  }
  EXPECT_GE(term.factors.size(), 4u);
}

TEST(KeyPointNoise, IsTheSameForTheSameSeed) {
  const Smooth curve = MakeSmooth(30);
  const std::vector<double> sigma(30, 0.02);
  const auto one = EstimateKeyPointNoise(curve.voltage_V, curve.current_A, sigma, {}, 50, 7);
  const auto two = EstimateKeyPointNoise(curve.voltage_V, curve.current_A, sigma, {}, 50, 7);
  EXPECT_EQ(one.relative_covariance, two.relative_covariance);
}

}  // namespace
}  // namespace lyrefit
