#include "lyrefit/diagnose/noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/median.h"
#include "lyrefit/diagnose/measurement.h"
#include "synthetic/curves.h"

namespace lyrefit {
namespace {

// Readings of a set, and residuals: the noise-free minus the measured currents, in units of the
// current scale.
struct Noisy {
  Measurement measurement;
  std::vector<double> residual;
  std::vector<char> used;
};

Noisy MakeNoisy(const std::vector<Recipe>& recipes) {
  std::vector<IvCurve> noisy, clean;
  for (Recipe recipe : recipes) {
    noisy.push_back(SyntheticCurve(recipe));
    recipe.noise_A = recipe.noise_relative = 0;
    clean.push_back(SyntheticCurve(recipe));
  }
  Noisy made;
  made.measurement = *MakeMeasurement(SetOf(noisy));
  const double scale = made.measurement.readings.scale.current_A;
  for (std::size_t c = 0; c < noisy.size(); ++c) {
    for (std::size_t k = 0; k < noisy[c].size(); ++k) {
      made.residual.push_back((clean[c].current_A[k] - noisy[c].current_A[k]) / scale);
    }
  }
  made.used.assign(made.residual.size(), 1);
  return made;
}

Noise EstimateNoiseOf(const Noisy& made, const DeviceNotes& notes = {}, const Grids& grids = {}) {
  Measurement measurement = made.measurement;
  measurement.notes = notes;
  measurement.values.grids = grids;
  return EstimateNoise(measurement, made.residual, made.used);
}

// Median over seeds of an estimate, relative to the true value.
template <class F>
double MedianOver(int seeds, F estimate) {
  std::vector<double> values;
  for (int seed = 1; seed <= seeds; ++seed) values.push_back(estimate(seed));
  return UpperMedian(values);
}

TEST(EstimateNoiseTest, FindsEqualNoise) {
  for (const int points : {25, 100, 400}) {
    const double ratio = MedianOver(21, [&](int seed) {
      Recipe recipe;
      recipe.points = points;
      recipe.seed = seed;
      const Noisy made = MakeNoisy({recipe});
      return UpperMedian(EstimateNoiseOf(made).sigma) * made.measurement.readings.scale.current_A /
             0.004;
    });
    EXPECT_GT(ratio, 0.9) << points;
    EXPECT_LT(ratio, 1.15) << points;
  }
}

TEST(EstimateNoiseTest, FindsNoiseInProportion) {
  std::vector<double> top, bottom;
  for (int seed = 1; seed <= 15; ++seed) {
    Recipe recipe;
    recipe.points = 200;
    recipe.noise_A = 1e-5;
    recipe.noise_relative = 0.003;
    recipe.seed = seed;
    const Noisy made = MakeNoisy({recipe});
    const Noise noise = EstimateNoiseOf(made);
    const auto& points = made.measurement.readings.points;
    top.push_back(noise.sigma.front() / 0.003);
    int smallest = 0;
    for (int k = 0; k < 200; ++k) {
      if (std::fabs(points[k].current) < std::fabs(points[smallest].current)) smallest = k;
    }
    bottom.push_back(noise.sigma[smallest]);
  }
  EXPECT_NEAR(UpperMedian(top), 1, 0.15);
  EXPECT_LT(UpperMedian(bottom), 0.3 * 0.003);
}

// The rounding step of the current is a lower limit of the noise estimate.
TEST(EstimateNoiseTest, NeverFallsBelowWhatAGridLeaves) {
  Recipe recipe;
  recipe.noise_A = 1e-6;
  Noisy made = MakeNoisy({recipe});
  const double grid = 0.01;
  for (const double sigma : EstimateNoiseOf(made, {}, {grid, grid}).sigma)
    EXPECT_GE(sigma, 0.25 * grid);
  const double step = 0.02;  // of noise that is mostly rounding
  RandomStream random(3);
  for (double& r : made.residual) r = step * (random.Uniform() - 0.5);
  const double found = UpperMedian(EstimateNoiseOf(made, {}, {step, step}).sigma);
  EXPECT_NEAR(found, step / std::sqrt(12), 0.3 * step / std::sqrt(12));
}

TEST(IsCoarseTest, WeighsAGridAgainstTheNoise) {
  Recipe recipe;
  recipe.points = 100;
  const Noisy made = MakeNoisy({recipe});
  const Noise noise = EstimateNoiseOf(made);
  const double sigma = UpperMedian(noise.sigma);
  const auto coarse = [&](const Grids& grids) {
    Measurement measurement = made.measurement;
    measurement.values.grids = grids;
    return IsCoarse(measurement, noise);
  };
  EXPECT_FALSE(coarse({0, 0}));
  EXPECT_FALSE(coarse({0.5 * sigma, 0}));
  EXPECT_TRUE(coarse({5 * sigma, 0}));
  EXPECT_FALSE(coarse({0, 5 * sigma}));  // the set has no dark curve
}

TEST(EstimateNoiseTest, SmoothMisfitIsNoNoise) {
  Recipe recipe;
  recipe.points = 150;
  Noisy made = MakeNoisy({recipe});
  const double before = UpperMedian(EstimateNoiseOf(made).sigma);
  for (std::size_t k = 0; k < made.residual.size(); ++k) {
    made.residual[k] += 0.02 * std::sin(4 * made.measurement.readings.points[k].x);
  }
  EXPECT_NEAR(UpperMedian(EstimateNoiseOf(made).sigma), before, 0.05 * before);
}

TEST(EstimateNoiseTest, StepsAndOutliersAreNoNoise) {
  Recipe recipe;
  recipe.points = 150;
  Noisy made = MakeNoisy({recipe});
  const double before = UpperMedian(EstimateNoiseOf(made).sigma);
  made.residual[40] += 0.05;
  for (std::size_t k = 90; k < made.residual.size(); ++k) made.residual[k] += 0.01;
  EXPECT_NEAR(UpperMedian(EstimateNoiseOf(made).sigma), before, 0.25 * before);
}

TEST(EstimateNoiseTest, DarkCurvesHaveTheirOwn) {
  Recipe lit, dark;
  lit.points = dark.points = 120;
  dark.irradiance_W_m2 = 0;
  dark.to_V = 0.5;
  dark.noise_A = 0.0002;
  dark.seed = 5;
  const Noisy made = MakeNoisy({lit, dark});
  const Noise noise = EstimateNoiseOf(made);
  const double scale = made.measurement.readings.scale.current_A;
  EXPECT_NEAR(noise.sigma.front() * scale, 0.004, 0.0012);
  EXPECT_NEAR(noise.dark.constant * scale, 0.0002, 0.00008);
}

TEST(EstimateNoiseTest, AStatedShapeIsKeptAndItsSizeMeasured) {
  Recipe recipe;
  recipe.points = 200;
  const Noisy made = MakeNoisy({recipe});
  DeviceNotes notes;
  notes.current_noise_constant_A = 0.04;  // ten times the true value
  notes.current_noise_relative = 0.0;
  const Noise noise = EstimateNoiseOf(made, notes);
  EXPECT_NEAR(noise.lit.constant * made.measurement.readings.scale.current_A, 0.004, 0.0008);
  EXPECT_NEAR(noise.sigma.front(), noise.sigma.back(), 1e-6 * noise.sigma.front());
}

TEST(EstimateNoiseTest, LeftOutReadingsDoNotCount) {
  Noisy made = MakeNoisy({Recipe()});
  const double before = UpperMedian(EstimateNoiseOf(made).sigma);
  for (const int k : {10, 20, 21, 30}) {
    made.residual[k] = 3;
    made.used[k] = 0;
  }
  EXPECT_NEAR(UpperMedian(EstimateNoiseOf(made).sigma), before, 0.25 * before);
}

TEST(EstimateNoiseTest, FewReadingsAndNoNoiseAreNoHarm) {
  Recipe recipe;
  recipe.points = 7;
  recipe.noise_A = 0;
  for (const double sigma : EstimateNoiseOf(MakeNoisy({recipe})).sigma) {
    EXPECT_TRUE(std::isfinite(sigma));
    EXPECT_GT(sigma, 0);
  }
  Noisy none = MakeNoisy({Recipe()});
  none.used.assign(none.used.size(), 0);
  for (const double sigma : EstimateNoiseOf(none).sigma) EXPECT_GT(sigma, 0);
}

Autocorrelation Correlate(double rho, int points, int seed) {
  Recipe recipe;
  recipe.points = points;
  Noisy made = MakeNoisy({recipe});
  RandomStream random(seed);
  double last = random.Normal();
  for (double& r : made.residual) {
    last = rho * last + std::sqrt(1 - rho * rho) * random.Normal();
    r = last;
  }
  return EstimateAutocorrelation(made.measurement.readings, made.residual, made.used, 5);
}

TEST(EstimateAutocorrelationTest, IsNothingForWhiteNoise) {
  double mean = 0, beyond = 0;
  constexpr int kSeeds = 200;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const Autocorrelation found = Correlate(0, 120, seed);
    mean += found.value / kSeeds;
    beyond += std::fabs(found.value) > 2.5 * found.standard_error;
  }
  EXPECT_NEAR(mean, 0, 0.03);
  EXPECT_LT(beyond / kSeeds, 0.04);
}

TEST(EstimateAutocorrelationTest, FindsThatOfAFirstOrderProcess) {
  for (const double rho : {0.3, 0.6}) {
    const double found = MedianOver(41, [&](int seed) { return Correlate(rho, 300, seed).value; });
    EXPECT_NEAR(found, rho, 0.12) << rho;
  }
}

TEST(EstimateAutocorrelationTest, SaysNothingOfFewReadings) {
  EXPECT_EQ(Correlate(0.9, 15, 1).value, 0);
  EXPECT_EQ(Correlate(0.9, 15, 1).standard_error, 1);
}

}  // namespace
}  // namespace lyrefit
