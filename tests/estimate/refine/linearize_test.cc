#include "lyrefit/estimate/refine/coordinates.h"

#include <gtest/gtest.h>

#include <cmath>

#include "estimate/refine/test_curves.h"
#include "lyrefit/estimate/refine/refine.h"

namespace lyrefit {
namespace {

TEST(Linearize, AgreesWithCentralDifferencesInEveryCoordinate) {
  for (const Objective objective : {Objective::kMeasuredCurrent, Objective::kSolvedCurrent}) {
    const RefineProblem problem =
        ModuleProblem(Model::kDoubleDiode, Model::kDoubleDiode, kDoubleTruth, 1e-3, objective);
    const std::vector<bool> active = {false, false, false, false, false, true, false};
    const CurveModel model(problem);
    const Linearization now = Linearize(model, {kDoubleTruth, {}}, active);
    ASSERT_EQ(now.parameter, (std::vector<int>{0, 1, 2, 3, 4, 6}));
    const Coordinates coordinates(model.shape(), kDoubleTruth, active);
    const auto evaluate = [&](const std::vector<double>& at, std::vector<double>* residuals) {
      return EvaluateBlock(model, coordinates, 0, at.data(), nullptr, 1.0, residuals->data(),
                           nullptr, nullptr);
    };
    const std::vector<double> theta = coordinates.Start();
    const int points = static_cast<int>(problem.voltage_V.size());
    for (int c = 0; c < coordinates.size(); ++c) {
      std::vector<double> up(points), down(points);
      std::vector<double> at = theta;
      const double step = 1e-6 * (1 + std::fabs(theta[c]));
      at[c] = theta[c] + step;
      ASSERT_TRUE(evaluate(at, &up));
      at[c] = theta[c] - step;
      ASSERT_TRUE(evaluate(at, &down));
      const double largest = now.jacobian.col(c).cwiseAbs().maxCoeff();
      for (int k = 0; k < points; ++k) {
        EXPECT_NEAR(now.jacobian(k, c), (up[k] - down[k]) / (2 * step), 1e-6 * largest)
            << ToText(objective) << " coordinate " << c << " point " << k;
      }
    }
  }
}

}  // namespace
}  // namespace lyrefit
