#include "lyrefit/certify/concave_floor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "certify/made.h"
#include "lyrefit/base/random.h"
#include "repeats.h"

namespace lyrefit {
namespace {

constexpr int kHalvings = 60;

// Two substrings of a module of 60 cells, the darker one with bypass diodes. Voltages at given
// currents are computed independently of the library. `bypass_nvt_V` 0 means an ideal diode.
struct TwoParts {
  double share = 1.0 / 3, light = 0.6, drop_V = 0.5, bypass_nvt_V = 0;
  double photocurrent_A = 8, n_vt_V = 60 * 0.0257 * 1.1, saturation_A = 1e-9, rs = 0.25;
  double shunt_S = 1e-3;

  // Current of a substring; `vd`: junction voltage scaled to all cells.
  double Junction(double vd, double lit) const {
    return lit * photocurrent_A - saturation_A * std::expm1(vd / n_vt_V) - vd * shunt_S;
  }
  // Voltage of a whole module under the light `lit`, at a current.
  double Alone(double i, double lit) const {
    double low = -1e5, high = 100;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (low + high);
      (Junction(middle, lit) > i ? low : high) = middle;
    }
    return low - i * rs;
  }
  double Dark(double i) const {
    if (bypass_nvt_V == 0) return std::max(share * Alone(i, light), -drop_V);
    // The bypass diode carries the current that the cells do not; at -drop_V it carries Isc.
    double low = -5, high = 100;
    const double unit = photocurrent_A / std::expm1(drop_V / bypass_nvt_V);
    for (int k = 0; k < kHalvings; ++k) {
      const double v = 0.5 * (low + high);
      const double diode = unit * std::expm1(-v / bypass_nvt_V);
      const double cells = i - diode;  // current of the cells at this voltage
      (share * Alone(cells, light) > v ? low : high) = v;
    }
    return low;
  }
  double Voltage(double i) const { return (1 - share) * Alone(i, 1) + Dark(i); }
  double Current(double v) const {
    double low = -1e3, high = 1.2 * photocurrent_A;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (low + high);
      (Voltage(middle) > v ? low : high) = middle;
    }
    return low;
  }
};

struct Drawn {
  std::vector<double> voltage_V, current_A;
  double noise_A = 0;  // root mean square of the drawn errors
};

Drawn Draw(const TwoParts& parts, int points, double noise_A, std::uint64_t seed) {
  RandomStream random(seed);
  Drawn drawn;
  double sum = 0;
  for (int k = 0; k < points; ++k) {
    const double v = 38.0 * k / (points - 1);
    const double error = noise_A * random.Normal();
    drawn.voltage_V.push_back(v);
    drawn.current_A.push_back(parts.Current(v) + error);
    sum += error * error;
  }
  drawn.noise_A = std::sqrt(sum / points);
  return drawn;
}

TwoParts SomeParts(RandomStream* random) {
  TwoParts parts;
  parts.share = 0.1 + 0.8 * random->Uniform();
  parts.light = 0.05 + 0.9 * random->Uniform();
  parts.drop_V = 0.2 + random->Uniform();
  parts.rs = random->Uniform();
  parts.shunt_S = 0.01 * random->Uniform();
  parts.n_vt_V *= 0.8 + random->Uniform();
  parts.saturation_A = 10 / std::expm1(36 / parts.n_vt_V);
  return parts;
}

// The true parameters leave the drawn noise as residual, so that the proved floor must not exceed
// it.
TEST(ConcaveFloor, LiesBelowTwoPartsOfAnyKind) {
  RandomStream random(1);
  for (int seed = 0; seed < Repeats(20); ++seed) {
    TwoParts parts = SomeParts(&random);
    const double noise = std::pow(10, -4 + 3 * random.Uniform());
    const Drawn ideal = Draw(parts, 60, noise, seed);
    EXPECT_LE(FindConcaveFloor(ideal.voltage_V, ideal.current_A, 0).step_A, ideal.noise_A) << seed;
    if (seed % 5 != 0) continue;  // slow
    parts.bypass_nvt_V = 1.2 * 0.0257;
    const Drawn real = Draw(parts, 60, noise, seed);
    EXPECT_LE(FindConcaveFloor(real.voltage_V, real.current_A, 1).step_A, real.noise_A) << seed;
  }
}

TEST(ConcaveFloor, LiesBelowEveryCurveWithoutAStep) {
  for (int seed = 0; seed < Repeats(40); ++seed) {
    const IvCurve curve = RandomCurve(seed);
    const auto floor = FindConcaveFloor(curve.voltage_V, curve.current_A, 0);
    EXPECT_LE(floor.step_A, floor.smooth_A * (1 + 1e-9)) << seed;
    // Random broken lines, which are concave curves without a step, have no smaller RMSE.
    double largest = 0;
    for (const double v : curve.voltage_V) largest = std::max(largest, v);
    RandomStream random(seed);
    for (int k = 0; k < 200; ++k) {
      const double level = curve.current_A[0] * (0.9 + 0.2 * random.Uniform());
      const double knee = largest * random.Uniform(), slope = level / largest * random.Uniform();
      const double steep = level / largest * 10 * random.Uniform();
      double sum = 0;
      for (std::size_t j = 0; j < curve.size(); ++j) {
        const double v = curve.voltage_V[j];
        const double r = level - slope * v - steep * std::max(v - knee, 0.0) - curve.current_A[j];
        sum += r * r;
      }
      EXPECT_GE(std::sqrt(sum / static_cast<double>(curve.size())), floor.smooth_A) << seed;
    }
  }
}

// Data with a step are far from every smooth curve and close to a curve with a step.
TEST(ConcaveFloor, TellsAStepFromNone) {
  const Drawn drawn = Draw(TwoParts(), 100, 0.01, 3);
  const auto floor = FindConcaveFloor(drawn.voltage_V, drawn.current_A, 1);
  EXPECT_GT(floor.smooth_A, 40 * drawn.noise_A);
  EXPECT_LT(floor.step_A, drawn.noise_A);
  EXPECT_GT(floor.step_A, 0.6 * drawn.noise_A);
  EXPECT_GT(floor.step_V, 20);
  EXPECT_LT(floor.step_V, 28);
  TwoParts whole;
  whole.light = 1;
  const Drawn plain = Draw(whole, 100, 0.01, 3);
  const auto smooth = FindConcaveFloor(plain.voltage_V, plain.current_A, 1);
  EXPECT_LT(smooth.smooth_A, plain.noise_A);
  EXPECT_GT(smooth.smooth_A, 0.6 * plain.noise_A);
}

TEST(ConcaveFloor, IsExactWhereItCanBeReckonedByHand) {
  // Rising currents: their mean fits best; one dent: the mean of its two points.
  EXPECT_NEAR(FindConcaveFloor({0, 1, 2, 3}, {1, 2, 3, 4}, 0).smooth_A, std::sqrt(5.0 / 4), 1e-12);
  EXPECT_NEAR(FindConcaveFloor({2, 0, 1}, {0, 4, 1}, 0).smooth_A, std::sqrt(2.0 / 9), 1e-12);
  EXPECT_NEAR(FindConcaveFloor({0, 1, 2, 3}, {4, 3.5, 2, 0}, 0).smooth_A, 0, 1e-12);
  EXPECT_NEAR(FindConcaveFloor({1, 1}, {0, 2}, 0).smooth_A, 1, 1e-12);
}

}  // namespace
}  // namespace lyrefit
