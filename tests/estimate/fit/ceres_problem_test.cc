#include <ceres/ceres.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/model/diode_residual.h"
#include "lyrefit/read/read_curve.h"

namespace lyrefit {
namespace {

// DiodeResidual by the logarithms of the saturation currents.
template <int kSize>
struct ByLogarithms {
  DiodeResidual residual;

  template <class T>
  bool operator()(const T* x, T* result) const {
    using std::exp;
    T p[kSize];
    for (int i = 0; i < kSize; ++i) p[i] = x[i];
    for (int i = 1; i < kSize; i += i == 1 ? 4 : 2) p[i] = exp(x[i]);  // Is1, Is2, Is3
    return residual(p, result);
  }
};

// The RMSE that a user's own problem reaches from `start`, within no other bounds than n >= 0.5 and
// none below 0.
template <int kSize>
double Solved(const IvCurve& curve, Model model, Objective objective, std::vector<double> start) {
  const Device device = MakeDevice(model, curve.conditions);
  ceres::Problem problem;
  for (int i = 1; i < kSize; i += i == 1 ? 4 : 2)
    start[static_cast<std::size_t>(i)] = std::log(start[static_cast<std::size_t>(i)]);
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const DiodeResidual one(device, objective, curve.voltage_V[k], curve.current_A[k]);
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<ByLogarithms<kSize>, 1, kSize>(
                                 new ByLogarithms<kSize>{one}),
                             nullptr, start.data());
  }
  problem.SetParameterLowerBound(start.data(), kIph, 0);
  problem.SetParameterLowerBound(start.data(), IdealityIndex(0), 0.5);
  problem.SetParameterLowerBound(start.data(), kRs, 0);
  problem.SetParameterLowerBound(start.data(), kRsh, 0);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 1000;
  options.function_tolerance = options.gradient_tolerance = options.parameter_tolerance = 1e-16;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return std::sqrt(2 * summary.final_cost / static_cast<double>(curve.size()));
}

TEST(CeresProblem, ReachesTheOptimumOfFit) {
  for (const char* name : {"rtc_france", "pwp201", "stm6_40_36"}) {
    const auto curve = ReadCurve(std::string(LYREFIT_DATA_DIR "/") + name);
    ASSERT_TRUE(curve) << curve.error().ToString();
    for (const Objective objective : {Objective::kSolvedCurrent, Objective::kMeasuredCurrent}) {
      FitOptions options;
      options.objective = objective;
      const auto report = Fit(*curve, options);
      ASSERT_TRUE(report) << report.error().ToString();
      // Some way off in every parameter.
      std::vector<double> start = report->refined;
      start[kIph] *= 1.02;
      start[SaturationCurrentIndex(0)] *= 3;
      start[IdealityIndex(0)] *= 1.08;
      start[kRs] *= 0.9;
      start[kRsh] *= 0.7;
      const double expected = report->rmse.refined.Of(objective);
      EXPECT_NEAR(Solved<5>(*curve, Model::kSingleDiode, objective, start) / expected, 1, 1e-8)
          << name << ' ' << ToText(objective);
    }
  }
}

TEST(CeresProblem, ReachesTheOptimumOfTwoDiodes) {
  const auto curve = ReadCurve(LYREFIT_DATA_DIR "/rtc_france");
  ASSERT_TRUE(curve);
  FitOptions options;
  options.model = Model::kDoubleDiode;
  const auto report = Fit(*curve, options);
  ASSERT_TRUE(report);
  std::vector<double> start = report->refined;
  start[kIph] *= 1.01;
  start[SaturationCurrentIndex(1)] *= 1.5;
  const double reached = Solved<7>(*curve, Model::kDoubleDiode, Objective::kSolvedCurrent, start);
  // Without the bounds of the fit it may end a little lower.
  EXPECT_LT(reached / report->rmse.refined.solved_current_A, 1 + 1e-6);
  EXPECT_GT(reached / report->rmse.refined.solved_current_A, 0.9);
}

}  // namespace
}  // namespace lyrefit
