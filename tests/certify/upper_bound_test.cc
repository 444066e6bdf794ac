#include "lyrefit/certify/upper_bound.h"

#include <gtest/gtest.h>

#include "certify/made.h"
#include "lyrefit/certify/interval.h"
#include "lyrefit/certify/relaxation.h"
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

double Cut(const MixtureData& data) { return data.reference_voltage_V / data.current_A.maxCoeff(); }

TEST(BoundTail, HoldsForEveryMixtureAtLargerResistances) {
  for (std::uint64_t seed = 300; seed < 310; ++seed) {
    const IvCurve curve = RandomCurve(seed);
    const MixtureData data = DataOf(curve);
    const double bound = BoundTail(data, 0.5 * Cut(data));
    for (const double factor : {0.5, 0.7, 1.0, 1.5, 3.0, 20.0}) {
      const double rs = factor * Cut(data);
      const Mixture mixture = SolveMixture(data, {WindowOf(curve, 0.5, 4)}, rs, {}, 1e-6, 20);
      EXPECT_GE(mixture.primal, bound * (1 - 1e-12)) << curve.name << " Rs x " << factor;
    }
  }
}

TEST(BoundTail, ShutsOutLargeResistancesOnEveryShippedCurve) {
  for (const char* name : {"rtc_france", "pwp201", "stm6_40_36", "stp6_120_36", "msx60"}) {
    const MixtureData data = DataOf(Shipped(name));
    const double largest = data.current_A.maxCoeff();
    EXPECT_GT(BoundTail(data, Cut(data)), 0.1 * largest * largest) << name;
    EXPECT_LT(BoundTail(data, 0), 1e-3 * largest * largest) << name;
  }
}

TEST(BoundTail, IsTheMeanOfTwoPointsInTheWrongOrder) {
  MixtureData data;
  data.voltage_V = Eigen::Vector3d(0, 0.5, 1);
  data.current_A = Eigen::Vector3d(1, 0.5, 0);
  EXPECT_EQ(BoundTail(data, 0.9), 0);
  EXPECT_EQ(BoundTail(data, 1.1), 0.25);
}

// Beyond a sufficiently large Rs, the order of the points is that of their currents, and no mixture
// fits better than the mean current.
TEST(BoundTail, IsTheSpreadOfTheCurrentsFarOut) {
  for (std::uint64_t seed = 310; seed < 320; ++seed) {
    MixtureData data = DataOf(RandomCurve(seed));
    const double far = 1e12 * Cut(data);
    const double spread = 0.5 * (data.current_A.array() - data.current_A.mean()).square().sum();
    EXPECT_NEAR(BoundTail(data, far) / spread, 1, 1e-12) << seed;
    EXPECT_LE(BoundTail<Interval>(data, far), BoundTail(data, far)) << seed;
    EXPECT_NEAR(BoundTail<Interval>(data, far) / spread, 1, 1e-12) << seed;
  }
}

}  // namespace
}  // namespace lyrefit
