#include "lyrefit/model/diode_residual.h"

#include <ceres/ceres.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "lyrefit/base/dual.h"
#include "lyrefit/base/random.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/estimate/refine/problem.h"
#include "lyrefit/model/device_effects.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/read/read_curve.h"
#include "model/open_circuit.h"
#include "repeats.h"
#include "synthetic/draw.h"

namespace lyrefit {
namespace {

constexpr Objective kBoth[] = {Objective::kMeasuredCurrent, Objective::kSolvedCurrent};

// A residual and its derivatives by all parameters.
struct Differentiated {
  double value = 0;
  std::vector<double> slopes;
};

template <int N>
Differentiated ByJets(const DiodeResidual& residual, const std::vector<double>& p) {
  ceres::Jet<double, N> jets[N], end;
  for (int i = 0; i < N; ++i) jets[i] = ceres::Jet<double, N>(p[i], i);
  EXPECT_TRUE(residual(jets, &end));
  return {end.a, {end.v.data(), end.v.data() + N}};
}

Differentiated Differentiate(const DiodeResidual& residual, const std::vector<double>& p) {
  switch (residual.size()) {
    case 5:
      return ByJets<5>(residual, p);
    case 7:
      return ByJets<7>(residual, p);
    case 9:
      return ByJets<9>(residual, p);
    default:
      return ByJets<11>(residual, p);
  }
}

// The same by the vector kernels: one current and one row of slopes for each point.
struct KernelRows {
  std::vector<double> currents;
  std::vector<double> slopes;
};

KernelRows ByKernel(const Device& device, Objective objective, const std::vector<double>& p,
                    const std::vector<double>& voltage_V, const std::vector<double>& current_A) {
  KernelRows rows;
  rows.currents.resize(voltage_V.size());
  rows.slopes.resize(voltage_V.size() * p.size());
  ModelCurrents(device, objective, p.data(), MakePointSet(voltage_V, current_A), FastestKernel(),
                rows.currents.data(), rows.slopes.data());
  return rows;
}

// A device and readings near its curve, drawn from ranges far wider than physical ones: Is down to
// 1e-15 A, n down to 0.5, Rs often at 0 or 2 ohm, voltages from -2 Voc to 4 Voc, where exponents
// are in the hundreds and the largest ones are cut off.
struct DrawnCurve {
  Device device;
  std::vector<double> p;
  std::vector<double> voltage_V, current_A;
};

DrawnCurve DrawCurve(RandomStream* random) {
  constexpr int kPoints = 10;
  DrawnCurve drawn;
  Conditions conditions;
  conditions.cells_in_series = 1 + static_cast<int>(random->Index(144));
  conditions.cell_temperature_K = Between(random, 250, 350);
  drawn.device = MakeDevice(static_cast<Model>(1 + random->Index(3)), conditions);
  std::vector<double>& p = drawn.p;
  p.resize(drawn.device.size());
  p[kIph] = LogUniform(random, 1e-3, 20);
  const std::uint64_t end = random->Index(4);
  p[kRs] = end == 0 ? 0 : end == 1 ? 2 : LogUniform(random, 1e-6, 2);
  p[kRsh] = LogUniform(random, 0.1, 1e6);
  for (int d = 0; d < DiodeCount(drawn.device); ++d) {
    p[SaturationCurrentIndex(d)] = LogUniform(random, 1e-15, 1e-4);
    p[IdealityIndex(d)] = Between(random, 0.5, 4);
  }
  const double voc = OpenCircuit(drawn.device, p.data());
  const double most = random->Index(5) == 0 ? 4 : 1.2;
  for (int k = 0; k < kPoints; ++k) drawn.voltage_V.push_back(voc * Between(random, -2, most));
  drawn.current_A = SolveCurrents(drawn.device, p.data(), drawn.voltage_V);
  for (double& current : drawn.current_A) {
    current += 0.02 * Between(random, -1, 1) * (std::fabs(current) + p[kIph]);
  }
  return drawn;
}

using Quad = boost::multiprecision::cpp_bin_float_quad;

// A derivative in 113 bits, and what it would be if all its summands had one sign: the scale of
// rounding errors in double. Derivatives cancel where Vd = V + Rs I or I is near 0 (that by Is is
// 1 - exp(Vd / n Vt)). They are then known to fewer digits, however they are computed.
struct Exact {
  Quad slope;
  double scale = 0;
};

// The derivatives of a current by all parameters, independently of the library except for the start
// of the root. Exponents are cut off as the library does.
std::vector<Exact> ExactSlopes(const DrawnCurve& drawn, Objective objective, int k) {
  const std::vector<Quad> p(drawn.p.begin(), drawn.p.end());
  const Quad voltage = drawn.voltage_V[k], measured = drawn.current_A[k];
  const int diodes = DiodeCount(drawn.device);
  std::vector<Quad> rise(diodes), width(diodes), steepness(diodes);
  Quad vd, f, slope, magnitude;
  const auto evaluate = [&] {
    f = p[kIph] - vd / p[kRsh];
    slope = -1 / p[kRsh];
    magnitude = p[kIph] + abs(vd) / p[kRsh];
    for (int d = 0; d < diodes; ++d) {
      const Quad saturation = p[SaturationCurrentIndex(d)];
      width[d] = p[IdealityIndex(d)] * Quad(drawn.device.module_thermal_voltage_V);
      const bool cut = vd / width[d] > Quad(kLargestExponent);
      rise[d] = exp(cut ? Quad(kLargestExponent) : vd / width[d]);
      steepness[d] = cut ? Quad(0) : Quad(saturation * rise[d] / width[d]);
      f -= saturation * (rise[d] - 1);
      slope -= steepness[d];
      magnitude += saturation * (rise[d] + 1);
    }
  };
  Quad current = measured, factor = 1;
  if (objective == Objective::kMeasuredCurrent) {
    vd = voltage + p[kRs] * measured;
    evaluate();
    magnitude = abs(measured);
  } else {
    vd = SolveOperatingPoint(drawn.device, drawn.p.data(), drawn.voltage_V[k]).junction_voltage_V;
    for (int step = 0; step < 4; ++step) {  // Newton's, from a root in double
      evaluate();
      vd -= (vd - voltage - p[kRs] * f) / (1 - p[kRs] * slope);
    }
    evaluate();
    current = f;
    factor = 1 / (1 - p[kRs] * slope);
  }
  const Quad reach = abs(voltage) + p[kRs] * magnitude;
  std::vector<Exact> exact(p.size());
  const auto set = [&](int i, const Quad& value, const Quad& scale) {
    exact[i] = {value * factor, static_cast<double>(Quad(scale * factor))};
  };
  set(kIph, 1, 1);
  set(kRs, slope * current, abs(slope) * magnitude);
  set(kRsh, vd / (p[kRsh] * p[kRsh]), reach / (p[kRsh] * p[kRsh]));
  for (int d = 0; d < diodes; ++d) {
    const Quad per_n = steepness[d] / p[IdealityIndex(d)];
    set(SaturationCurrentIndex(d), 1 - rise[d], 1 + rise[d]);
    set(IdealityIndex(d), per_n * vd, per_n * reach);
  }
  return exact;
}

TEST(DiodeResidual, HasTheValuesAndDerivativesOfTheVectorKernelsAndOfMultiprecision) {
  constexpr int kDevices = Repeats(1000);
  constexpr double kTolerance = 1e-12;
  RandomStream random(20);
  double worst[2] = {0, 0};
  for (int draw = 0; draw < kDevices; ++draw) {
    const DrawnCurve drawn = DrawCurve(&random);
    const std::size_t count = drawn.p.size();
    for (const Objective objective : kBoth) {
      const KernelRows kernel =
          ByKernel(drawn.device, objective, drawn.p, drawn.voltage_V, drawn.current_A);
      for (std::size_t k = 0; k < drawn.voltage_V.size(); ++k) {
        SCOPED_TRACE(ToText(objective) + ", draw " + std::to_string(draw) + ", point " +
                     std::to_string(k));
        const DiodeResidual residual(drawn.device, objective, drawn.voltage_V[k],
                                     drawn.current_A[k]);
        const Differentiated own = Differentiate(residual, drawn.p);
        double plain = 0;
        ASSERT_TRUE(residual(drawn.p.data(), &plain));
        ASSERT_EQ(plain, own.value);
        double scale = std::fabs(kernel.currents[k]) + std::fabs(drawn.current_A[k]);
        scale += Prepare(drawn.device, drawn.p.data()).largest_current;  // Iph + sum of Is
        ASSERT_NEAR(own.value, kernel.currents[k] - drawn.current_A[k], kTolerance * scale);
        const std::vector<Exact> exact = ExactSlopes(drawn, objective, static_cast<int>(k));
        for (std::size_t i = 0; i < count; ++i) {
          const double allowed = kTolerance * exact[i].scale;
          ASSERT_NEAR(own.slopes[i], kernel.slopes[k * count + i], allowed)
              << drawn.device.parameters[i].symbol;
          const double error = std::fabs(static_cast<double>(own.slopes[i] - exact[i].slope));
          ASSERT_LE(error, allowed) << drawn.device.parameters[i].symbol;
          worst[0] = std::max(worst[0], std::fabs(own.slopes[i] - kernel.slopes[k * count + i]) /
                                            std::max(exact[i].scale, 1e-300));
          worst[1] = std::max(worst[1], error / std::max(exact[i].scale, 1e-300));
        }
      }
    }
  }
  RecordProperty("worst_kernel", std::to_string(worst[0] * 1e15) + "e-15");
  RecordProperty("worst_exact", std::to_string(worst[1] * 1e15) + "e-15");
}

TEST(DiodeResidual, TakesRecombination) {
  Conditions conditions;
  conditions.cells_in_series = 36;
  Device device = MakeDevice(Model::kTripleDiode, conditions);
  AddRecombination(&device);
  const std::vector<double> p = {3.8, 2e-9, 1.07, 0.25, 300, 4e-6, 1.9, 1e-6, 2.5, 1.2, 30};
  const std::vector<double> voltage_V = {-1, 0, 10, 19, 21}, current_A = {3.7, 3.7, 3.6, 1.5, -2};
  for (const Objective objective : kBoth) {
    const KernelRows kernel = ByKernel(device, objective, p, voltage_V, current_A);
    for (std::size_t k = 0; k < voltage_V.size(); ++k) {
      const DiodeResidual residual(device, objective, voltage_V[k], current_A[k]);
      const Differentiated own = Differentiate(residual, p);
      ASSERT_EQ(own.slopes.size(), p.size());
      EXPECT_NEAR(own.value, kernel.currents[k] - current_A[k], 1e-12);
      for (std::size_t i = 0; i < p.size(); ++i) {
        const double expected = kernel.slopes[k * p.size() + i];
        EXPECT_NEAR(own.slopes[i], expected, 1e-12 * std::fabs(expected))
            << device.parameters[i].symbol << " point " << k;
      }
    }
  }
}

TEST(DiodeResidual, TakesTheLibrarysOwnDualNumbers) {
  const Device device = MakeDevice(Model::kSingleDiode, {});
  const std::vector<double> p = {0.76, 3e-10, 1.2, 0.04, 50};
  for (const Objective objective : kBoth) {
    const DiodeResidual residual(device, objective, 0.5, 0.7);
    const Differentiated jets = Differentiate(residual, p);
    Dual<5> duals[5], end;
    for (int i = 0; i < 5; ++i) duals[i] = Dual<5>(p[i], i);
    ASSERT_TRUE(residual(duals, &end));
    EXPECT_DOUBLE_EQ(end.a, jets.value);
    for (int i = 0; i < 5; ++i) EXPECT_NEAR(end.v[i] / jets.slopes[i], 1, 1e-14) << i;
  }
}

TEST(DiodeResidual, IsMultipliedByItsWeight) {
  const Device device = MakeDevice(Model::kSingleDiode, {});
  const std::vector<double> p = {0.76, 3e-10, 1.2, 0.04, 50};
  for (const Objective objective : kBoth) {
    const Differentiated plain = Differentiate({device, objective, 0.5, 0.7}, p);
    const Differentiated weighted = Differentiate({device, objective, 0.5, 0.7, 250}, p);
    EXPECT_NE(plain.value, 0);
    EXPECT_DOUBLE_EQ(weighted.value, 250 * plain.value);
    for (int i = 0; i < 5; ++i) EXPECT_DOUBLE_EQ(weighted.slopes[i], 250 * plain.slopes[i]) << i;
  }
}

TEST(DiodeResidual, RefusesWhatIsNotFinite) {
  const Device device = MakeDevice(Model::kSingleDiode, {});
  const double p[] = {0.76, 3e-10, 1.2, 0.04, 50};
  const double broken[] = {std::nan(""), 3e-10, 1.2, 0.04, 50};
  double value = 0;
  for (const Objective objective : kBoth) {
    EXPECT_TRUE(DiodeResidual(device, objective, 0.5, 0.7)(p, &value));
    EXPECT_FALSE(DiodeResidual(device, objective, 0.5, 0.7)(broken, &value));
    EXPECT_FALSE(DiodeResidual(device, objective, std::nan(""), 0.7)(p, &value));
    EXPECT_FALSE(DiodeResidual(device, objective, 0.5, HUGE_VAL)(p, &value));
  }
}

TEST(DiodeResidual, TakesNoDeviceWithEffects) {
  Device device = MakeDevice(Model::kSingleDiode, {});
  device.effects = std::make_shared<DeviceEffects>();
  EXPECT_DEATH(DiodeResidual(device, Objective::kSolvedCurrent, 0.5, 0.7), "effects");
}

// A fit by Ceres alone, with this residual, against Fit.
struct OptimumCase {
  std::string data_set;
  Model model;
  Objective objective;
  BoundsSpec::Table bounds;
};

void PrintTo(const OptimumCase& c, std::ostream* out) {
  *out << c.data_set << ' ' << ToText(c.model) << ' ' << ToText(c.objective);
}

// A start from the end points of the curve: the largest current, a share of V / I for both
// resistances, an n, and the Is that carries the largest current at the largest voltage.
std::vector<double> PlainStart(const Device& device, const IvCurve& curve,
                               const std::vector<double>& idealities) {
  const double current = *std::max_element(curve.current_A.begin(), curve.current_A.end());
  const double voltage = *std::max_element(curve.voltage_V.begin(), curve.voltage_V.end());
  std::vector<double> p(device.size());
  p[kIph] = current;
  p[kRs] = 0.05 * voltage / current;
  p[kRsh] = 50 * voltage / current;
  for (std::size_t d = 0; d < idealities.size(); ++d) {
    const double width = idealities[d] * device.module_thermal_voltage_V;
    p[SaturationCurrentIndex(static_cast<int>(d))] = current * std::exp(-voltage / width);
    p[IdealityIndex(static_cast<int>(d))] = idealities[d];
  }
  return p;
}

class Optimum : public ::testing::TestWithParam<OptimumCase> {};

// The sums of squares agree to rounding, the parameters to about its square root: near an optimum
// the sum of squares does not change to first order.
TEST_P(Optimum, OfCeresAloneIsThatOfFit) {
  const OptimumCase& c = GetParam();
  const auto curve = ReadCurve(LYREFIT_DATA_DIR "/" + c.data_set);
  ASSERT_TRUE(curve.has_value());
  FitOptions options;
  options.model = c.model;
  options.objective = c.objective;
  options.intervals = Intervals::kNone;
  options.bounds.name = "published";
  options.bounds.table = c.bounds;
  const auto fit = Fit(*curve, options);
  ASSERT_TRUE(fit.has_value());
  const Device device = MakeDevice(c.model, curve->conditions);
  const auto bounds = MakeBounds(options.bounds, device, *curve);
  ASSERT_TRUE(bounds.has_value());

  const bool two = c.model == Model::kDoubleDiode;
  std::vector<double> p =
      PlainStart(device, *curve, two ? std::vector<double>{1.4, 2} : std::vector<double>{1.3});
  ceres::Problem problem;
  for (std::size_t k = 0; k < curve->size(); ++k) {
    auto* cost = new ceres::DynamicAutoDiffCostFunction<DiodeResidual, 9>(
        new DiodeResidual(device, c.objective, curve->voltage_V[k], curve->current_A[k]));
    cost->AddParameterBlock(device.size());
    cost->SetNumResiduals(1);
    problem.AddResidualBlock(cost, nullptr, p.data());
  }
  for (int i = 0; i < device.size(); ++i) {
    problem.SetParameterLowerBound(p.data(), i, bounds->at(i).lower);
    problem.SetParameterUpperBound(p.data(), i, bounds->at(i).upper);
  }
  // Fit ends at the upper bound 2 of the second diode's n. Ceres alone hardly moves along a bound
  // with these residuals, so n2 is held there.
  if (two) {
    EXPECT_EQ(fit->refined[IdealityIndex(1)], 2);
    problem.SetManifold(p.data(), new ceres::SubsetManifold(device.size(), {IdealityIndex(1)}));
  }
  ceres::Solver::Options how;
  how.linear_solver_type = ceres::DENSE_QR;
  how.max_num_iterations = 500;
  how.function_tolerance = how.gradient_tolerance = how.parameter_tolerance = 1e-16;
  how.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(how, &problem, &summary);
  EXPECT_EQ(summary.termination_type, ceres::CONVERGENCE) << summary.BriefReport();

  const double rmse = Rmse(device, c.objective, p.data(), curve->voltage_V, curve->current_A);
  EXPECT_NEAR(std::sqrt(2 * summary.final_cost / curve->size()) / rmse, 1, 1e-11);
  EXPECT_NEAR(rmse / fit->rmse.refined.Of(c.objective), 1, 1e-11);
  double farthest = 0;
  for (int i = 0; i < device.size(); ++i) {
    EXPECT_NEAR(p[i] / fit->refined[i], 1, 1e-5) << device.parameters[i].symbol;
    farthest = std::max(farthest, std::fabs(p[i] / fit->refined[i] - 1));
  }
  RecordProperty("iterations", static_cast<int>(summary.iterations.size()));
  RecordProperty("rmse_difference",
                 std::to_string((rmse / fit->rmse.refined.Of(c.objective) - 1) * 1e15) + "e-15");
  RecordProperty("parameter_difference", std::to_string(farthest * 1e9) + "e-9");
}

std::vector<OptimumCase> OptimumCases() {
  const BoundsSpec::Table cell = {
      {"Iph", {0, 10}}, {"Is", {0, 1e-5}}, {"n", {1, 2}}, {"Rs", {0, 2}}, {"Rsh", {0, 100}}};
  const BoundsSpec::Table pwp201 = {{"Iph", {0, 2}},
                                    {"Is", {0, 5e-5}},
                                    {"n", {1.0 / 36, 50.0 / 36}},
                                    {"Rs", {0, 2}},
                                    {"Rsh", {0, 2000}}};
  const BoundsSpec::Table stm6 = {
      {"Iph", {0, 2}}, {"Is", {0, 5e-5}}, {"n", {1, 60}}, {"Rs", {0, 12.96}}, {"Rsh", {0, 36000}}};
  std::vector<OptimumCase> cases;
  for (const Objective objective : kBoth) {
    cases.push_back({"rtc_france", Model::kSingleDiode, objective, cell});
    cases.push_back({"rtc_france", Model::kDoubleDiode, objective, cell});
    cases.push_back({"pwp201", Model::kSingleDiode, objective, pwp201});
    cases.push_back({"stm6_40_36", Model::kSingleDiode, objective, stm6});
  }
  return cases;
}

std::string CaseName(const ::testing::TestParamInfo<OptimumCase>& info) {
  std::string name =
      info.param.data_set + '_' + ToText(info.param.model) + '_' + ToText(info.param.objective);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Data, Optimum, ::testing::ValuesIn(OptimumCases()), CaseName);

}  // namespace
}  // namespace lyrefit
