#include "lyrefit/estimate/fit/simulate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "error_of.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/read/read_curve.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

SimulateOptions Module() {
  SimulateOptions options;
  options.parameters = {{"Iph", 8.2}, {"Is1", 2e-9}, {"n", 1.15}, {"Rs", 0.25}, {"Rsh", 300}};
  options.conditions.cells_in_series = 60;
  options.conditions.cell_temperature_K = 318.15;
  return options;
}

TEST(Simulate, EndsALittleBeyondOpenCircuit) {
  const auto curve = Simulate(Module());
  ASSERT_TRUE(curve) << curve.error().ToString();
  ASSERT_EQ(curve->size(), 100U);
  EXPECT_EQ(curve->voltage_V.front(), 0);
  EXPECT_GT(curve->current_A[97], 0);  // 97/99 of 1.02 Voc is still below Voc
  EXPECT_LT(curve->current_A.back(), 0);
}

TEST(Simulate, PointsLieOnTheTerminalLaw) {
  const SimulateOptions options = Module();
  const auto curve = Simulate(options);
  ASSERT_TRUE(curve);
  const Device device = MakeDevice(options.model, options.conditions);
  const double p[] = {8.2, 2e-9, 1.15, 0.25, 300};
  for (std::size_t i = 0; i < curve->size(); ++i) {
    EXPECT_NEAR(curve->current_A[i], SolveOperatingPoint(device, p, curve->voltage_V[i]).current_A,
                1e-13);
  }
}

TEST(Simulate, NoiseHasTheSizeAskedForAndFollowsTheSeed) {
  SimulateOptions options = Module();
  options.points = 20000;
  const auto clean = Simulate(options);
  options.noise_A = 0.003;
  options.noise_relative = 0.001;
  const auto noisy = Simulate(options);
  const auto again = Simulate(options);
  options.seed = 1;
  const auto other = Simulate(options);
  ASSERT_TRUE(clean && noisy && again && other);
  EXPECT_EQ(noisy->current_A, again->current_A);
  EXPECT_NE(noisy->current_A, other->current_A);
  double sum = 0;
  for (std::size_t i = 0; i < clean->size(); ++i) {
    const double sigma = std::hypot(0.003, 0.001 * clean->current_A[i]);
    sum += std::pow((noisy->current_A[i] - clean->current_A[i]) / sigma, 2);
  }
  EXPECT_NEAR(sum / static_cast<double>(clean->size()), 1, 0.04);
  EXPECT_EQ(noisy->notes.current_noise_constant_A, 0.003);
}

TEST(Simulate, TakesAPerfectShuntAndADeadDiode) {
  SimulateOptions options = Module();
  options.model = Model::kDoubleDiode;
  options.parameters["Rsh"] = std::numeric_limits<double>::infinity();
  options.parameters["Is2"] = 0;
  options.parameters["n2"] = 2;
  const auto curve = Simulate(options);
  ASSERT_TRUE(curve) << curve.error().ToString();
  EXPECT_NEAR(curve->current_A.front(), 8.2, 1e-6);
}

void ExpectRefused(const SimulateOptions& options, const char* says) {
  EXPECT_THAT(MessageOf(Simulate(options)), HasSubstr(says));
}

TEST(Simulate, RefusesWhatIsNoDevice) {
  for (const auto& [symbol, value] : std::map<std::string, double>{
           {"Rsh", 0}, {"Rs", -1}, {"Is1", -1e-9}, {"Iph", kNoNumber}, {"n1", 0}}) {
    SimulateOptions options = Module();
    options.parameters.erase("n");
    options.parameters["n1"] = 1.15;
    options.parameters[symbol] = value;
    ExpectRefused(options, symbol.c_str());
  }
  SimulateOptions options = Module();
  options.parameters.erase("Rs");
  ExpectRefused(options, "no value for Rs");
  options = Module();
  options.parameters["n2"] = 2;
  ExpectRefused(options, "no parameter n2");
}

TEST(Simulate, RefusesOptionsOutsideTheirRanges) {
  SimulateOptions options = Module();
  options.points = 1;
  ExpectRefused(options, "points");
  options = Module();
  options.noise_A = -1;
  ExpectRefused(options, "noise");
  options = Module();
  options.conditions.cells_in_series = 0;
  ExpectRefused(options, "cell");
  options = Module();
  options.voltage_V = {0, kNoNumber};
  ExpectRefused(options, "voltage");
  options = Module();
  options.parameters["Iph"] = 0;
  ExpectRefused(options, "open-circuit");
}

TEST(RmseOf, IsThatOfTheFitsReport) {
  const auto curve = ReadCurve(LYREFIT_DATA_DIR "/rtc_france");
  ASSERT_TRUE(curve);
  for (const Model model : {Model::kSingleDiode, Model::kDoubleDiode, Model::kTripleDiode}) {
    FitOptions options;
    options.model = model;
    options.intervals = Intervals::kNone;
    const auto report = Fit(*curve, options);
    ASSERT_TRUE(report);
    std::map<std::string, double> by_symbol, by_name;
    for (const Estimate& e : report->estimates) {
      by_symbol[e.info.symbol] = by_name[e.info.name] = e.refined;
    }
    for (const auto& parameters : {by_symbol, by_name}) {
      const auto rmse = RmseOf(*curve, parameters);
      ASSERT_TRUE(rmse) << rmse.error().ToString();
      EXPECT_EQ(rmse->measured_current_A, report->rmse.refined.measured_current_A);
      EXPECT_EQ(rmse->solved_current_A, report->rmse.refined.solved_current_A);
    }
  }
}

TEST(RmseOf, RefusesWhatIsNoDevice) {
  const auto curve = ReadCurve(LYREFIT_DATA_DIR "/rtc_france");
  ASSERT_TRUE(curve);
  const auto error = [&](std::map<std::string, double> parameters) {
    return RmseOf(*curve, parameters).error().ToString();
  };
  EXPECT_THAT(error({{"Iph", 0.76}, {"Is1", 3e-7}, {"n", 1.5}, {"Rs", 0.04}}),
              HasSubstr("no value for Rsh"));
  EXPECT_THAT(error({{"Iph", 0.76}, {"Is2", 3e-7}}), HasSubstr("no value for Is1"));
  EXPECT_THAT(error({{"Iph", 0.76}, {"shading.d", 0.5}}),
              HasSubstr("the model has no parameter shading.d"));
  EXPECT_THAT(error({{"Iph", 0.76}, {"Is1", 3e-7}, {"n", 0}, {"Rs", 0.04}, {"Rsh", 50}}),
              HasSubstr("expected n1 above 0, found 0"));
}

}  // namespace
}  // namespace lyrefit
