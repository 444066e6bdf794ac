#include "lyrefit/refine/jacobian.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/refine/coordinates.h"
#include "lyrefit/refine/residuals.h"
#include "refine/test_curves.h"

namespace lyrefit {
namespace {

TEST(Linearize, AgreesWithCentralDifferencesInEveryCoordinate) {
  for (const Objective objective : {Objective::kMeasuredCurrent, Objective::kSolvedCurrent}) {
    const RefineProblem problem =
        ModuleProblem(Model::kDoubleDiode, Model::kDoubleDiode, kDoubleTruth, 1e-3, objective);
    const std::vector<bool> held = {false, false, false, false, false, true, false};
    const Linearization now = Linearize(problem, kDoubleTruth, held);
    ASSERT_EQ(now.parameter, (std::vector<int>{0, 1, 2, 3, 4, 6}));
    const Coordinates coordinates(problem, kDoubleTruth, held);
    const CurveResiduals residuals(problem, coordinates, 1.0);
    const std::vector<double> theta = coordinates.Start();
    const int points = static_cast<int>(problem.voltage_V.size());
    for (int c = 0; c < coordinates.size(); ++c) {
      std::vector<double> up(points), down(points);
      std::vector<double> at = theta;
      const double step = 1e-6 * (1 + std::fabs(theta[c]));
      at[c] = theta[c] + step;
      ASSERT_TRUE(residuals.Evaluate(at.data(), up.data(), nullptr));
      at[c] = theta[c] - step;
      ASSERT_TRUE(residuals.Evaluate(at.data(), down.data(), nullptr));
      const double largest = now.jacobian.col(c).cwiseAbs().maxCoeff();
      for (int k = 0; k < points; ++k) {
        EXPECT_NEAR(now.jacobian(k, c), (up[k] - down[k]) / (2 * step), 1e-6 * largest)
            << ToText(objective) << " coordinate " << c << " point " << k;
      }
    }
  }
}

TEST(Coordinates, GoThereAndBack) {
  const RefineProblem problem = ModuleProblem(Model::kDoubleDiode, Model::kDoubleDiode,
                                              kDoubleTruth, 0, Objective::kSolvedCurrent);
  const Coordinates coordinates(problem, kDoubleTruth, std::vector<bool>(7, false));
  const std::vector<double> theta = coordinates.Start();
  std::vector<double> p(7);
  coordinates.ToParameters(theta.data(), p.data());
  for (int i = 0; i < 7; ++i) EXPECT_NEAR(p[i] / kDoubleTruth[i], 1, 1e-13);
}

}  // namespace
}  // namespace lyrefit
