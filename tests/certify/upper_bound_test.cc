#include "lyrefit/certify/upper_bound.h"

#include <gtest/gtest.h>

#include "certify/made.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {
namespace {

constexpr double kTolerance = 1e-10;

ModelRanges BoundsOf(const MixtureData& data, double n_lower, double n_upper) {
  return {n_lower, n_upper, 0, data.reference_voltage_V / data.current_A.maxCoeff(),
          data.reference_voltage_V};
}

TEST(FindUpperBound, FindsTheOptimumOfEveryModelFromAMixtureFarAway) {
  const IvCurve curve = Shipped("rtc_france");
  const MixtureData data = DataOf(curve);
  const Mixture far = SolveMixture(data, {WindowOf(curve, 1, 2)}, 0.01, {}, kTolerance, 2);
  const double optimum[] = {9.860218779e-4, 9.824848761e-4, 9.824848761e-4};
  for (const Model model : {Model::kSingleDiode, Model::kDoubleDiode, Model::kTripleDiode}) {
    const ModelRanges ranges = BoundsOf(data, 1, 2);
    const RefineProblem problem = ModelProblem(curve, MakeDevice(model, curve.conditions), ranges);
    UpperBound best;
    FindUpperBound(problem, ranges, data, far, &best);
    const double rmse = Rmse(problem.device, Objective::kMeasuredCurrent, best.p.data(),
                             curve.voltage_V, curve.current_A);
    EXPECT_NEAR(std::sqrt(best.mean_square) / rmse, 1, 1e-12);
    EXPECT_NEAR(rmse / optimum[static_cast<int>(model) - 1], 1, 2e-9) << ToText(model);
  }
}

TEST(FindUpperBound, KeepsWhatIsBetterAlready) {
  const IvCurve curve = Shipped("rtc_france");
  const MixtureData data = DataOf(curve);
  const Mixture mixture = SolveMixture(data, {WindowOf(curve, 1, 2)}, 0.01, {}, kTolerance, 2);
  UpperBound best = {{1, 2, 3, 4, 5}, 1e-20};
  FindUpperBound(
      ModelProblem(curve, MakeDevice(Model::kSingleDiode, curve.conditions), BoundsOf(data, 1, 2)),
      BoundsOf(data, 1, 2), data, mixture, &best);
  EXPECT_EQ(best.p, (std::vector<double>{1, 2, 3, 4, 5}));
}

// A module with so small an n that the device cuts exponents. With cut exponents, the RMSE would
// differ from that of Shockley's equation.
TEST(FindUpperBound, ClaimsNothingThatShockleysEquationDoesNotGive) {
  const IvCurve curve = Shipped("stp6_120_36");
  const MixtureData data = DataOf(curve);
  const Mixture mixture =
      SolveMixture(data, {WindowOf(curve, 0.05, 100)}, 0.35, {}, kTolerance, 20);
  const Device device = MakeDevice(Model::kDoubleDiode, curve.conditions);
  UpperBound best;
  const ModelRanges ranges = BoundsOf(data, 0.05, 100);
  FindUpperBound(ModelProblem(curve, device, ranges), ranges, data, mixture, &best);
  double squares = 0;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const double vd = curve.voltage_V[k] + best.p[kRs] * curve.current_A[k];
    double residual = best.p[kIph] - vd / best.p[kRsh] - curve.current_A[k];
    for (int d = 0; d < 2; ++d) {
      residual -= best.p[SaturationCurrentIndex(d)] *
                  std::expm1(vd / (best.p[IdealityIndex(d)] * device.module_thermal_voltage_V));
    }
    squares += residual * residual;
  }
  EXPECT_NEAR(squares / static_cast<double>(curve.size()) / best.mean_square, 1, 1e-9);
}

}  // namespace
}  // namespace lyrefit
