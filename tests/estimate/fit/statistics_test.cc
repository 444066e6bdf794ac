#include "lyrefit/estimate/fit/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/base/random.h"

namespace lyrefit {
namespace {

TEST(StudentT95, HasTheTabulatedValues) {
  EXPECT_NEAR(StudentT95(1), 12.7062, 1e-4);
  EXPECT_NEAR(StudentT95(10), 2.22814, 1e-5);
  EXPECT_NEAR(StudentT95(1000), 1.96234, 1e-5);
  EXPECT_EQ(StudentT95(0), StudentT95(1));
  EXPECT_NEAR(StudentT95(10), 2.22814, 1e-5);  // earlier calls have no influence
}

TEST(FTestPValue, HasTheTabulatedValues) {
  // The 5 % point of F(2, 19) is 3.5219.
  EXPECT_NEAR(FTestPValue(1 + 2 * 3.5219 / 19, 1, 2, 19), 0.05, 1e-5);
  EXPECT_EQ(FTestPValue(1, 1, 2, 19), 1);
  EXPECT_TRUE(std::isnan(FTestPValue(2, 1, 2, 0)));
}

TEST(FindInformation, IsTheTextbookFormula) {
  const InformationCriteria c = FindInformation(4e-6, 26, 5);
  EXPECT_NEAR(c.bic, 26 * std::log(4e-6) + 6 * std::log(26.0), 1e-9);
  EXPECT_NEAR(c.aicc, 26 * std::log(4e-6) + 12 + 2.0 * 6 * 7 / 19, 1e-9);
  EXPECT_TRUE(std::isnan(FindInformation(1e-6, 7, 5).aicc));
}

TEST(FindResidualStatistics, CountsRunsInOrderOfVoltage) {
  const ResidualStatistics s = FindResidualStatistics({3, 1, 2, 4, 5, 6}, {-1, 1, 2, -3, 1, 1});
  EXPECT_EQ(s.runs, 3);  // 1 2 | -1 -3 | 1 1
  EXPECT_EQ(s.largest_A, 3);
  EXPECT_EQ(s.largest_at_V, 4);
  EXPECT_NEAR(s.expected_runs, 2.0 * 4 * 2 / 6 + 1, 1e-12);
  EXPECT_NEAR(s.durbin_watson, (1 + 9 + 4 + 16 + 0) / 17.0, 1e-12);
}

TEST(FindResidualStatistics, TellsWavesFromNoise) {
  std::vector<double> v, wave, noise;
  RandomStream random(8);
  for (int k = 0; k < 60; ++k) {
    v.push_back(k);
    wave.push_back(std::sin(k / 6.0));
    noise.push_back(random.Normal());
  }
  EXPECT_LT(FindResidualStatistics(v, wave).runs_p_value, 1e-6);
  EXPECT_GT(FindResidualStatistics(v, noise).runs_p_value, 0.01);
}

TEST(NoiseFromDifferences, SeesTheNoiseUnderASmoothCurve) {
  std::vector<double> v, values;
  RandomStream random(9);
  for (int k = 0; k < 400; ++k) {
    v.push_back(k);
    values.push_back(std::exp(k / 100.0) + 0.01 * random.Normal());
  }
  EXPECT_NEAR(NoiseFromDifferences(v, values), 0.01, 0.002);
}

TEST(NoiseFromDifferencesTest, CopiesOfAPointCountOnce) {
  RandomStream random(3);
  std::vector<double> voltage_V, values, twice_V, twice;
  for (int k = 0; k < 50; ++k) {
    voltage_V.push_back(k);
    values.push_back(random.Normal());
    twice_V.insert(twice_V.end(), 4, voltage_V.back());
    twice.insert(twice.end(), 4, values.back());
  }
  const double noise = NoiseFromDifferences(voltage_V, values);
  EXPECT_NEAR(noise, 1, 0.4);
  EXPECT_EQ(NoiseFromDifferences(twice_V, twice), noise);
}

}  // namespace
}  // namespace lyrefit
