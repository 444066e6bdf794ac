#include "lyrefit/model/kernel.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/base/random.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {
namespace {

Device Module(Model model) {
  Conditions conditions;
  conditions.cells_in_series = 36;
  return MakeDevice(model, conditions);
}

const std::vector<double> kParameters = {3.8, 5e-9, 1.15, 0.3, 230, 2e-8, 1.4, 1e-7, 1.9};

TEST(Kernels, ThePortableOneIsAlwaysThere) {
  ASSERT_FALSE(AvailableKernels().empty());
  EXPECT_STREQ(AvailableKernels().front().name, "portable");
}

TEST(MeanSquare, IsTheMeanOfTheScalarResidualsForBothObjectives) {
  for (const int points : {1, 7, 8, 9, 26}) {
    std::vector<double> v, i, w;
    for (int k = 0; k < points; ++k) {
      v.push_back(21.0 * k / points);
      i.push_back(3.7 - 0.1 * k);
      w.push_back(1 + 0.1 * k);
    }
    const Device device = Module(Model::kTripleDiode);
    const PointSet set = MakePointSet(v, i, w);
    double measured = 0, solved = 0, weight = 0;
    for (int k = 0; k < points; ++k) {
      const double a = ExplicitCurrent(device, kParameters.data(), v[k], i[k]) - i[k];
      const double b = SolveOperatingPoint(device, kParameters.data(), v[k]).current_A - i[k];
      measured += w[k] * a * a;
      solved += w[k] * b * b;
      weight += w[k];
    }
    EXPECT_NEAR(MeanSquare(device, Objective::kMeasuredCurrent, kParameters.data(), set) /
                    (measured / weight),
                1, 1e-12);
    EXPECT_NEAR(
        MeanSquare(device, Objective::kSolvedCurrent, kParameters.data(), set) / (solved / weight),
        1, 1e-12);
  }
}

TEST(MeanSquare, GivesTheSameBitsOnEveryKernel) {
  RandomStream random(3);
  std::vector<double> v, i;
  for (int k = 0; k < 29; ++k) {
    v.push_back(-1 + 0.8 * k);
    i.push_back(3.8 * random.Uniform());
  }
  const PointSet set = MakePointSet(v, i);
  for (const Model model : {Model::kSingleDiode, Model::kDoubleDiode, Model::kTripleDiode}) {
    const Device device = Module(model);
    for (int draw = 0; draw < 500; ++draw) {
      std::vector<double> p = kParameters;
      for (double& x : p) x *= 0.5 + random.Uniform();
      for (const Objective objective : {Objective::kMeasuredCurrent, Objective::kSolvedCurrent}) {
        const double first = MeanSquare(device, objective, p.data(), set, AvailableKernels()[0]);
        for (const Kernel& kernel : AvailableKernels()) {
          ASSERT_EQ(MeanSquare(device, objective, p.data(), set, kernel), first) << kernel.name;
        }
      }
    }
  }
}

// The portable kernel consists of additions, multiplications and divisions in a fixed order, so
// that these bits hold on every IEEE 754 machine.
TEST(MeanSquare, OfThePortableKernelHasTheseBits) {
  std::vector<double> v, i;
  for (int k = 0; k < 20; ++k) {
    v.push_back(k * 1.125);
    i.push_back(3.75 - k * 0.0625);
  }
  const PointSet set = MakePointSet(v, i);
  const Device device = Module(Model::kTripleDiode);
  const Kernel& portable = AvailableKernels()[0];
  EXPECT_EQ(MeanSquare(device, Objective::kMeasuredCurrent, kParameters.data(), set, portable),
            0x1.85bb030dd7078p+0);
  EXPECT_EQ(MeanSquare(device, Objective::kSolvedCurrent, kParameters.data(), set, portable),
            0x1.0274242939f0fp-1);
}

TEST(MeanSquare, StaysFiniteFarOutsideTheBox) {
  const Device device = Module(Model::kSingleDiode);
  const PointSet set = MakePointSet({-50, 0, 21, 100}, {5, 4, 0, -80});
  for (const double n : {0.0, 0.01, 1.0}) {
    for (const double is : {0.0, 1e-9, 1.0}) {
      for (const double rs : {0.0, 10.0}) {
        for (const double rsh : {0.0, 1e12}) {
          const double p[] = {4, is, n, rs, rsh};
          for (const Objective o : {Objective::kMeasuredCurrent, Objective::kSolvedCurrent}) {
            EXPECT_TRUE(std::isfinite(MeanSquare(device, o, p, set))) << n << ' ' << is;
          }
        }
      }
    }
  }
}

TEST(MakePointSet, ScalesWeightsToMeanOneAndIgnoresTheFiller) {
  const PointSet set = MakePointSet({1, 2, 3}, {1, 1, 1}, {2, 4, 6});
  EXPECT_DOUBLE_EQ(set.weight[0].lane[0], 0.5);
  EXPECT_DOUBLE_EQ(set.weight[0].lane[2], 1.5);
  EXPECT_EQ(set.weight[0].lane[3], 0);
  EXPECT_EQ(set.largest_voltage_V, 3);
}

}  // namespace
}  // namespace lyrefit
