#include "lyrefit/estimate/refine/coordinates.h"

#include <gtest/gtest.h>

#include <cmath>

#include "estimate/refine/test_curves.h"
#include "lyrefit/estimate/refine/refine.h"

namespace lyrefit {
namespace {

enum { kCurrent, kSaturation, kN, kResistance, kShunt, kDark, kExponent, kAny };

// One parameter of every kind.
ModelShape EveryKind() {
  ModelShape shape;
  shape.current_scale_A = 4;
  shape.voltage_scale_V = 20;
  shape.thermal_voltage_V = 0.9;
  const auto add = [&](ParameterKind kind, double step, std::array<int, 2> with, double lower,
                       double upper) {
    shape.parameters.push_back({kind, step, with, lower, upper});
  };
  add(ParameterKind::kPhotocurrent, 1, {-1, -1}, 0, 8);
  add(ParameterKind::kSaturation, 1, {kN, -1}, 1e-12, 1e-4);
  add(ParameterKind::kIdeality, 1, {-1, -1}, 1, 2);
  add(ParameterKind::kSeries, 1, {-1, -1}, 0, 3);
  add(ParameterKind::kShunt, 1, {-1, -1}, 5, 1e9);
  add(ParameterKind::kDarkShunt, 1, {kShunt, kExponent}, 0, HUGE_VAL);
  add(ParameterKind::kPlain, 1, {-1, -1}, 1, 10);
  add(ParameterKind::kPlain, 0.01, {-1, -1}, -1, 1);
  return shape;
}

const std::vector<double> kAt = {3.8, 2e-8, 1.2, 0.25, 300, 1200, 5.5, -0.003};
const std::vector<bool> kNone(8, false);

TEST(Coordinates, GoThereAndBack) {
  const ModelShape shape = EveryKind();
  const Coordinates coordinates(shape, kAt, kNone);
  std::vector<double> p(8);
  coordinates.ToParameters(coordinates.Start().data(), p.data());
  for (int i = 0; i < 8; ++i) EXPECT_NEAR(p[i] / kAt[i], 1, 1e-13) << i;
}

TEST(Coordinates, HaveTheSlopesOfCentralDifferences) {
  const ModelShape shape = EveryKind();
  std::vector<bool> without_dark = kNone, without_n = kNone;
  without_dark[kDark] = without_n[kN] = true;
  for (const std::vector<bool>& active : {kNone, without_dark, without_n}) {
    const Coordinates coordinates(shape, kAt, active);
    const std::vector<Coordinates::Slope> slopes = coordinates.Slopes(kAt.data());
    for (int k = 0; k < coordinates.size(); ++k) {
      std::vector<double> up = coordinates.Start(), down = up, high(8), low(8);
      const double step = 1e-6 * (1 + std::fabs(up[k]));
      up[k] += step;
      down[k] -= step;
      coordinates.ToParameters(up.data(), high.data());
      coordinates.ToParameters(down.data(), low.data());
      for (int i = 0; i < 8; ++i) {
        double claimed = 0;
        for (const Coordinates::Slope& slope : slopes) {
          if (slope.parameter == i && slope.coordinate == k) claimed += slope.value;
        }
        const double slope = (high[i] - low[i]) / (2 * step);
        EXPECT_NEAR(claimed, slope, 1e-6 * std::fabs(slope) + 1e-15) << i << " by " << k;
      }
    }
  }
}

TEST(Coordinates, BoundASaturationCurrentOnlyWhereItsIdealityIsHeld) {
  const ModelShape shape = EveryKind();
  EXPECT_TRUE(std::isinf(Coordinates(shape, kAt, kNone).lower(kSaturation)));
  std::vector<bool> active = kNone;
  active[kN] = true;
  const Coordinates coordinates(shape, kAt, active);
  std::vector<double> theta = coordinates.Start(), p(8);
  for (const bool lower : {true, false}) {
    theta[kSaturation] = lower ? coordinates.lower(kSaturation) : coordinates.upper(kSaturation);
    coordinates.ToParameters(theta.data(), p.data());
    EXPECT_NEAR(p[kSaturation] / (lower ? 1e-12 : 1e-4), 1, 1e-12);
  }
}

TEST(Coordinates, AreLinearInTheLogarithmOfASaturationCurrent) {
  const ModelShape shape = EveryKind();
  const Coordinates coordinates(shape, kAt, kNone);
  std::vector<double> theta = coordinates.Start(), p(8);
  theta[kSaturation] += 1.5;
  theta[kN] *= 0.9;
  coordinates.ToParameters(theta.data(), p.data());
  EXPECT_NEAR(coordinates.Own(kSaturation, theta), std::log(p[kSaturation] / 4), 1e-12);
  EXPECT_NEAR(coordinates.OwnUpper(kSaturation), std::log(1e-4 / 4), 1e-12);
}

TEST(Coordinates, KeepADarkShuntBetweenTheShuntAndWhatTheExponentAllows) {
  const ModelShape shape = EveryKind();
  const Coordinates coordinates(shape, kAt, kNone);
  EXPECT_EQ(coordinates.upper(kDark), 1);
  EXPECT_NEAR(coordinates.lower(kDark), std::exp(-5.5), 1e-15);
  EXPECT_EQ(coordinates.AtBound(kDark, /*lower=*/false, kAt), 300);
  // A fixed dark shunt keeps its ratio to the shunt.
  std::vector<bool> active = kNone;
  active[kDark] = true;
  const Coordinates rest(shape, kAt, active);
  std::vector<double> theta = rest.Start(), p(8);
  theta[kShunt] *= 2;
  rest.ToParameters(theta.data(), p.data());
  EXPECT_NEAR(p[kShunt], 150, 1e-10);
  EXPECT_NEAR(p[kDark], 600, 1e-10);
}

TEST(Coordinates, SayWhereABoundLiesExactly) {
  const ModelShape shape = EveryKind();
  const Coordinates coordinates(shape, kAt, kNone);
  for (const int i : {kCurrent, kSaturation, kResistance, kExponent, kAny}) {
    EXPECT_EQ(coordinates.AtBound(i, true, kAt), shape.parameters[i].lower) << i;
    EXPECT_EQ(coordinates.AtBound(i, false, kAt), shape.parameters[i].upper) << i;
  }
  for (const int i : {kN, kShunt}) {  // coordinates that fall with the parameter
    EXPECT_EQ(coordinates.AtBound(i, true, kAt), shape.parameters[i].upper) << i;
    EXPECT_EQ(coordinates.AtBound(i, false, kAt), shape.parameters[i].lower) << i;
  }
}

TEST(Linearize, AgreesWithCentralDifferencesInEveryCoordinate) {
  for (const Objective objective : {Objective::kMeasuredCurrent, Objective::kSolvedCurrent}) {
    const RefineProblem problem =
        ModuleProblem(Model::kDoubleDiode, Model::kDoubleDiode, kTwoDiodeTruth, 1e-3, objective);
    const std::vector<bool> active = {false, false, false, false, false, true, false};
    const CurveModel model(problem);
    const Linearization now = Linearize(model, {kTwoDiodeTruth, {}}, active);
    ASSERT_EQ(now.parameter, (std::vector<int>{0, 1, 2, 3, 4, 6}));
    const Coordinates coordinates(model.shape(), kTwoDiodeTruth, active);
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
