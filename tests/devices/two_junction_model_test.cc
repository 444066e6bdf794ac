#include "lyrefit/devices/two_junction_problem.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/base/constants.h"

namespace lyrefit {
namespace {

// Two curves; the bottom junction's light of the second is a parameter of its own.
TwoJunctionProblem TandemProblem(bool ordered) {
  TwoJunctionProblem problem;
  problem.parameters = TwoJunctionInfos();
  problem.parameters.push_back(
      {"Iph2[red]", "photocurrent_2[red]", "A", "", ParameterKind::kPhotocurrent});
  problem.lower.assign(10, 1e-30);
  problem.upper.assign(10, 1e9);
  problem.thermal_voltage_V = ThermalVoltage(298.15);
  problem.current_scale_A = 0.02;
  problem.voltage_scale_V = 0.8;
  problem.ordered = ordered;
  const std::vector<double> voltage_V = {0, 0.8, 1.4, 1.6};
  const std::vector<double> current_A = {0.019, 0.018, 0.014, -0.001};
  problem.curves = {{voltage_V, current_A, {{{0, 1}, {4, 1}}}},
                    {voltage_V, current_A, {{{0, 0.9}, {9, 1}}}}};
  return problem;
}

TEST(TwoJunctionModel, SlopesAreCentralDifferences) {
  for (const bool ordered : {false, true}) {
    const TwoJunctionProblem problem = TandemProblem(ordered);
    const TwoJunctionModel model(problem);
    std::vector<double> p = {0.0195, 1e-14, 1.4,  3000, ordered ? 0.05 : 0.0202,
                             3e-10,  1.2,   1500, 2.0,  0.021};
    for (int block = 0; block < 2; ++block) {
      std::vector<double> residuals(4), slopes(40), above(4), below(4);
      ASSERT_TRUE(
          model.Evaluate(block, p.data(), nullptr, residuals.data(), slopes.data(), nullptr));
      for (int i = 0; i < 10; ++i) {
        const double at = p[i], step = 1e-5 * at;
        p[i] = at + step;
        model.Evaluate(block, p.data(), nullptr, above.data(), nullptr, nullptr);
        p[i] = at - step;
        model.Evaluate(block, p.data(), nullptr, below.data(), nullptr, nullptr);
        p[i] = at;
        for (int k = 0; k < 4; ++k) {
          const double expected = (above[k] - below[k]) / (2 * step) * at;
          EXPECT_NEAR(slopes[10 * k + i] * at, expected, 1e-8 + 1e-6 * std::fabs(expected))
              << ordered << " " << block << " " << k << " " << i;
        }
      }
    }
  }
}

TEST(TwoJunctionModel, SharesScaleTheCommonPhotocurrents) {
  const TwoJunctionProblem problem = TandemProblem(/*ordered=*/true);
  const std::vector<double> p = {0.02, 1e-14, 1.4, 3000, 0.1, 3e-10, 1.2, 1500, 2.0, 0.021};
  const auto white = DeviceIn(problem, 0, p.data()), red = DeviceIn(problem, 1, p.data());
  EXPECT_DOUBLE_EQ(white[JunctionPhotocurrent(0)], 0.02);
  EXPECT_DOUBLE_EQ(white[JunctionPhotocurrent(1)], 0.022);
  EXPECT_DOUBLE_EQ(red[JunctionPhotocurrent(0)], 0.018);
  EXPECT_DOUBLE_EQ(red[JunctionPhotocurrent(1)], 0.021);
}

}  // namespace
}  // namespace lyrefit
