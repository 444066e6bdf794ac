#include "lyrefit/estimate/refine/problem.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/model/kernel.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {
namespace {

TEST(ModelCurrents, HaveTheSlopesOfCentralDifferencesByEveryParameter) {
  Conditions conditions;
  conditions.cells_in_series = 36;
  Device device = MakeDevice(Model::kTripleDiode, conditions);
  AddRecombination(&device);
  const std::vector<double> p = {3.8, 2e-9, 1.07, 0.25, 300, 4e-6, 1.9, 1e-6, 2.5, 1.2, 30};
  ASSERT_EQ(device.size(), static_cast<int>(p.size()));
  std::vector<double> voltage, measured;
  for (int k = 0; k < 20; ++k) voltage.push_back(-1 + 1.1 * k);
  const PointSet unmeasured = MakePointSet(voltage, voltage);
  measured = SolveCurrents(device, p.data(), unmeasured);
  for (double& current : measured) current += 0.01;
  const PointSet set = MakePointSet(voltage, measured);
  const std::size_t count = p.size();
  for (const Objective objective : {Objective::kMeasuredCurrent, Objective::kSolvedCurrent}) {
    const auto currents = [&](const std::vector<double>& at, double* slopes) {
      std::vector<double> current(voltage.size());
      ModelCurrents(device, objective, at.data(), set, FastestKernel(), current.data(), slopes);
      return current;
    };
    std::vector<double> slopes(voltage.size() * count);
    const std::vector<double> middle = currents(p, slopes.data());
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<double> up = p, down = p;
      const double step = 1e-5 * p[i];
      up[i] += step;
      down[i] -= step;
      const std::vector<double> high = currents(up, nullptr), low = currents(down, nullptr);
      for (std::size_t k = 0; k < voltage.size(); ++k) {
        const double slope = (high[k] - low[k]) / (2 * step);
        EXPECT_NEAR(slopes[k * count + i] * p[i], slope * p[i], 1e-6 * (1 + std::fabs(middle[k])))
            << ToText(objective) << ' ' << device.parameters[i].name << " point " << k;
      }
    }
    for (std::size_t k = 0; k < voltage.size(); ++k) {
      const double expected = objective == Objective::kMeasuredCurrent
                                  ? ExplicitCurrent(device, p.data(), voltage[k], measured[k])
                                  : SolveOperatingPoint(device, p.data(), voltage[k]).current_A;
      EXPECT_NEAR(middle[k], expected, 1e-12 * (1 + std::fabs(expected)));
    }
  }
}

}  // namespace
}  // namespace lyrefit
