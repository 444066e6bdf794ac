#include "lyrefit/devices/joint_estimate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "lyrefit/devices/describe_cell.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/model/model_points.h"
#include "repeats.h"
#include "synthetic/curves.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr double kJointNoise_A = 1e-6;

// What is measured of one cell.
struct Measured {
  std::vector<double> truth = kCellTruth;
  double collection = 0;  // 1/V
  std::vector<double> lights = {1000};
  bool dark = false;
  bool trace = false;  // Suns-Voc, from 0.02 to 1.2 suns
  std::uint64_t seed = 0;
};

// Parameters of the device under a light.
std::vector<double> UnderLight(const Measured& cell, double light) {
  std::vector<double> p = cell.truth;
  p[kIph] *= light / 1000;
  p[kRsh] = 1 / (1 / p[kRsh] + cell.collection * p[kIph]);
  return p;
}

IvCurve TraceOf(const Measured& cell, double voltage_noise_V, RandomStream* random) {
  constexpr int kPoints = 40;
  IvCurve curve = CellSweepOf(cell.truth, 1000);
  curve.suns_voc_A = 1.2 * cell.truth[kIph];
  curve.voltage_V.clear();
  curve.current_A.clear();
  const Device device = MakeDevice(Model::kSingleDiode, curve.conditions);
  for (int k = 0; k < kPoints; ++k) {
    const double suns = 0.02 * std::pow(60.0, k / (kPoints - 1.0));
    const std::vector<double> p = UnderLight(cell, 1000 * suns);
    curve.voltage_V.push_back(ModelOpenCircuit(device, p.data()) +
                              voltage_noise_V * random->Normal());
    curve.current_A.push_back(*curve.suns_voc_A - p[kIph]);
  }
  return curve;
}

CellReport DescriptionOf(const Measured& cell) {
  RandomStream random(7, cell.seed);
  std::vector<IvCurve> curves;
  std::vector<double> lights = cell.lights;
  if (cell.dark) lights.push_back(0);
  for (const double light : lights) {
    std::vector<double> p = UnderLight(cell, light);
    p[kIph] = cell.truth[kIph];  // CellSweepOf scales it
    IvCurve curve = CellSweepOf(p, light);
    for (double& current : curve.current_A) current += kJointNoise_A * random.Normal();
    curves.push_back(std::move(curve));
  }
  if (cell.trace) curves.push_back(TraceOf(cell, 2e-4, &random));
  CellOptions options;
  options.threads = 1;
  const auto report = DescribeCell(CellOf(curves), options);
  EXPECT_TRUE(report) << report.error().ToString();
  return *report;
}

const Estimate& ParameterOf(const JointEstimate& joint, const std::string& symbol) {
  for (const Estimate& e : joint.estimates) {
    if (e.info.symbol == symbol) return e;
  }
  ADD_FAILURE() << symbol;
  return joint.estimates.front();
}

double WithoutIt(const JointEstimate& joint, std::size_t measurement, const std::string& symbol) {
  for (std::size_t i = 0; i < joint.estimates.size(); ++i) {
    if (joint.estimates[i].info.symbol == symbol) {
      return joint.measurements[measurement].without[i];
    }
  }
  return -1;
}

TEST(JointEstimate, OneLitCurveHasNone) { EXPECT_FALSE(DescriptionOf({}).joint); }

TEST(JointEstimate, IntervalsHoldTheTruth) {
  SKIP_IF_SANITIZED();
  constexpr int kCells = Repeats(200);
  std::map<std::string, int> held;
  for (int s = 0; s < kCells; ++s) {
    Measured cell;
    RandomStream random(3, s);
    cell.truth = {5e-3, 2e-13 * std::exp(random.Normal()), 1.3 + 0.1 * random.Normal(),
                  4 * std::exp(0.3 * random.Normal()), 8000 * std::exp(0.5 * random.Normal())};
    cell.collection = 0.02 * std::exp(0.3 * random.Normal());
    cell.lights = s % 2 == 0 ? std::vector<double>{1000} : std::vector<double>{1000, 200};
    cell.dark = true;
    cell.trace = s % 3 == 0;
    cell.seed = s;
    const CellReport report = DescriptionOf(cell);
    ASSERT_TRUE(report.joint);
    const std::map<std::string, double> truth = {{"Is1", cell.truth[1]},
                                                 {"n1", cell.truth[2]},
                                                 {"Rs", cell.truth[3]},
                                                 {"Rsh", cell.truth[4]},
                                                 {"c", cell.collection}};
    for (const auto& [symbol, value] : truth) {
      const Estimate& e = ParameterOf(*report.joint, symbol);
      held[symbol] += e.low_95 <= value && value <= e.high_95 ? 1 : 0;
    }
    EXPECT_FALSE(report.joint->second_diode) << s;
    EXPECT_THAT(report.joint->void_because, IsEmpty()) << s;
  }
  // Four standard errors of the count below 95 %.
  const double least = 0.95 * kCells - 4 * std::sqrt(0.95 * 0.05 * kCells);
  for (const auto& [symbol, count] : held) {
    RecordProperty(symbol, count);
    EXPECT_GE(count, least) << symbol;
  }
}

TEST(JointEstimate, ADarkCurveTellsAShuntFromCollection) {
  Measured cell;
  cell.truth[kRsh] = 1e9;
  cell.collection = 0.03;
  cell.dark = true;
  const CellReport photoshunt = DescriptionOf(cell);
  const JointEstimate& collects = *photoshunt.joint;
  EXPECT_EQ(collects.collection_part, 1);
  EXPECT_THAT(collects.shunt, HasSubstr("collection that depends on voltage; no shunt"));
  EXPECT_NEAR(ParameterOf(collects, "c").refined, 0.03, 0.002);

  cell.truth[kRsh] = 1 / (0.03 * cell.truth[kIph]);
  cell.collection = 0;
  const CellReport shunted = DescriptionOf(cell);
  const JointEstimate& leaks = *shunted.joint;
  EXPECT_EQ(leaks.collection_part, 0);
  EXPECT_EQ(shunted.losses.at(0).parts.at(1).name, "shunt");
  EXPECT_THAT(leaks.shunt, HasSubstr("stays in the dark: a shunt"));
  EXPECT_NEAR(ParameterOf(leaks, "Rsh").refined, cell.truth[kRsh], 60);
  // Without the dark curve nothing tells them apart.
  EXPECT_TRUE(std::isnan(WithoutIt(leaks, 1, "c")));
  EXPECT_TRUE(std::isnan(WithoutIt(leaks, 1, "Rsh")));
}

TEST(JointEstimate, EveryMeasurementAddsToTheCertainty) {
  Measured cell;
  cell.lights = {1000, 100};
  cell.dark = cell.trace = true;
  const JointEstimate joint = *DescriptionOf(cell).joint;
  ASSERT_EQ(joint.measurements.size(), 4U);
  for (std::size_t b = 0; b < 4; ++b) {
    for (const char* symbol : {"Is1", "n1", "Rs", "Rsh", "c"}) {
      EXPECT_GE(WithoutIt(joint, b, symbol), 1 - 1e-9) << b << symbol;
    }
  }
  // The light of the trace is found, although it is stated with its own short-circuit current.
  EXPECT_NEAR(ParameterOf(joint, "s[Suns-Voc]").refined, 1, 0.01);
}

TEST(JointEstimate, ADarkCurveThatDoesNotConductHasNone) {
  RandomStream random(2);
  Measured cell;
  IvCurve dark = CellSweepOf(kCellTruth, 0);
  for (std::size_t k = 0; k < dark.size(); ++k) {
    dark.voltage_V[k] -= 1;
    dark.current_A[k] = -dark.voltage_V[k] / 9000;
  }
  const auto reverse = DescribeCell(CellOf({dark, TraceOf(cell, 2e-4, &random)}));
  ASSERT_TRUE(reverse);
  EXPECT_FALSE(reverse->joint);

  const auto forward = DescribeCell(
      CellOf({CellSweepOf(kCellTruth, 0, false, kJointNoise_A), TraceOf(cell, 2e-4, &random)}));
  ASSERT_TRUE(forward && forward->joint);
  EXPECT_NEAR(ParameterOf(*forward->joint, "n1").refined, kCellTruth[2], 0.02);
}

TEST(JointEstimate, ASecondDiodeIsFound) {
  Measured cell;
  cell.dark = true;
  cell.truth = {5.5e-3, 1e-15, 1.15, 6, 9000};
  RandomStream random(1);
  std::vector<IvCurve> curves;
  for (const double light : {1000.0, 0.0}) {
    IvCurve curve = CellSweepOf(cell.truth, light);
    const std::vector<double> p = {5.5e-3 * light / 1000, 1e-15, 1.15, 6, 9000, 1e-11, 2};
    curve.current_A =
        SolveCurrents(MakeDevice(Model::kDoubleDiode, curve.conditions), p.data(), curve.voltage_V);
    for (double& current : curve.current_A) current += kJointNoise_A * random.Normal();
    curves.push_back(std::move(curve));
  }
  const auto report = DescribeCell(CellOf(curves));
  ASSERT_TRUE(report && report->joint);
  EXPECT_TRUE(report->joint->second_diode);
  EXPECT_FALSE(report->joint->warmer);
  EXPECT_LT(report->joint->second_diode_p, 1e-3);
  const Estimate& second = ParameterOf(*report->joint, "Is2");
  EXPECT_LT(second.low_95, 1e-11);
  EXPECT_GT(second.high_95, 1e-11);
}

// A lit cell that is 2 K warmer, or colder, than the dark one is no second diode.
TEST(JointEstimate, ADifferenceOfTemperatureIsFound) {
  constexpr double kDark_K = 298.15, kGap_V = 1.36, kBoltzmann_V_per_K = 8.617333e-5;
  for (const double kelvin : {2.0, -2.0}) {
    std::vector<double> lit = kCellTruth;
    const double ratio = (kDark_K + kelvin) / kDark_K, n = lit[2];
    lit[1] *= std::pow(ratio, 3 / n) *
              std::exp(kGap_V / (n * kBoltzmann_V_per_K * kDark_K) * (1 - 1 / ratio));
    lit[2] *= ratio;
    const auto report = DescribeCell(CellOf({CellSweepOf(lit, 1000, false, kJointNoise_A),
                                             CellSweepOf(kCellTruth, 0, false, kJointNoise_A)}));
    ASSERT_TRUE(report && report->joint);
    const JointEstimate& joint = *report->joint;
    EXPECT_TRUE(joint.warmer);
    EXPECT_FALSE(joint.second_diode);
    EXPECT_THAT(joint.void_because, IsEmpty());
    EXPECT_NEAR(ParameterOf(joint, "dT").refined, kelvin, 0.2);
    EXPECT_NEAR(ParameterOf(joint, "n1").refined, kCellTruth[2], 0.02);
    EXPECT_NEAR(joint.voc_per_K, -1.9e-3, 0.3e-3);
  }
}

TEST(JointEstimate, CurvesOfUnlikeDevicesAreVoidTogether) {
  std::vector<double> warmer = kCellTruth;
  warmer[1] *= 3;
  const auto report = DescribeCell(CellOf({CellSweepOf(kCellTruth, 1000, false, kJointNoise_A),
                                           CellSweepOf(warmer, 0, false, kJointNoise_A)}));
  ASSERT_TRUE(report && report->joint);
  EXPECT_THAT(report->joint->void_because, Not(IsEmpty()));
}

}  // namespace
}  // namespace lyrefit
