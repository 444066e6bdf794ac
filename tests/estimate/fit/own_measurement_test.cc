#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/estimate/fit/estimate_parameters.h"
#include "lyrefit/estimate/fit/simulate.h"
#include "lyrefit/estimate/refine/problem.h"

// A measurement of one's own, as a FitModel that goes the way of every other: two curves of one device, the
// second under another light and through an instrument of unknown gain.

namespace lyrefit {
namespace {

constexpr int kIph2 = 5, kGain = 6, kSize = 7;

// Parameters: those of the single-diode model, the photocurrent of the second curve, the gain.
struct GainProblem {
  Device device;
  PointSet points[2];
  std::vector<double> current_A[2];
  std::vector<ParameterInfo> infos;
  std::vector<double> lower = {0, 1e-12, 0.8, 0, 1, 0, 0.5};
  std::vector<double> upper = {10, 1e-5, 2, 1, 1e5, 10, 2};
};

class GainModel : public FitModel {
 public:
  explicit GainModel(const GainProblem& of) : FitModel(ShapeOf(of)), of_(of) {}

  bool Evaluate(int block, const double* p, const double*, double* residuals, double* slopes,
                double*) const override {
    double own[5] = {block == 0 ? p[0] : p[kIph2], p[1], p[2], p[3], p[4]};
    const double gain = block == 0 ? 1 : p[kGain];
    const int count = of_.points[block].size;
    std::vector<double> current(count), by(slopes != nullptr ? 5 * count : 0);
    ModelCurrents(of_.device, Objective::kSolvedCurrent, own, of_.points[block], FastestKernel(),
                  current.data(), slopes != nullptr ? by.data() : nullptr);
    for (int k = 0; k < count; ++k) {
      residuals[k] = gain * current[k] - of_.current_A[block][k];
      if (!std::isfinite(residuals[k])) return false;
      if (slopes == nullptr) continue;
      double* row = slopes + kSize * k;
      std::fill_n(row, kSize, 0.0);
      for (int i = 1; i < 5; ++i) row[i] = gain * by[5 * k + i];
      row[block == 0 ? 0 : kIph2] = gain * by[5 * k];
      if (block == 1) row[kGain] = current[k];
    }
    return true;
  }

 private:
  static ModelShape ShapeOf(const GainProblem& of) {
    ModelShape shape;
    SetBlocks({of.points[0].size, of.points[1].size}, &shape);
    shape.current_scale_A = 8;
    shape.voltage_scale_V = 40;
    shape.thermal_voltage_V = of.device.module_thermal_voltage_V;
    SetParameters(of.infos, of.lower, of.upper, &shape);
    return shape;
  }
  const GainProblem& of_;
};

IvCurve Made(double iph, std::uint64_t seed) {
  SimulateOptions options;
  options.conditions.cells_in_series = 60;
  options.parameters = {{"Iph", iph}, {"Is1", 2e-9}, {"n1", 1.1}, {"Rs", 0.3}, {"Rsh", 300}};
  options.points = 80;
  options.noise_A = 0.004;
  options.seed = seed;
  return *Simulate(options);
}

GainProblem MadeProblem(double gain) {
  IvCurve curves[2] = {Made(8.2, 1), Made(4.1, 2)};
  for (double& current : curves[1].current_A) current *= gain;
  GainProblem made;
  made.device = MakeDevice(Model::kSingleDiode, curves[0].conditions);
  made.infos = made.device.parameters;
  made.infos.push_back({"Iph2", "photocurrent_2", "A", "", ParameterKind::kPhotocurrent});
  made.infos.push_back({"gain", "current_gain", "", ""});
  for (int c = 0; c < 2; ++c) {
    made.points[c] = MakePointSet(curves[c].voltage_V, curves[c].current_A);
    made.current_A[c] = curves[c].current_A;
  }
  return made;
}

TEST(OwnMeasurement, AnUnknownGainIsFoundWithItsInterval) {
  const GainProblem gain = MadeProblem(1.03);
  const GainModel model(gain);
  EstimateProblem problem{model, MakeEstimates(gain.infos, gain.lower, gain.upper)};
  problem.readings = 160;
  problem.starts = {{"guess", {8, 1e-8, 1.2, 0.2, 200, 4, 1}}};
  const EstimatedParameters found = EstimateParameters(problem, {}, {});
  EXPECT_TRUE(found.report.usable);
  const double truth[kSize] = {8.2, 2e-9, 1.1, 0.3, 300, 4.1, 1.03};
  for (int i = 0; i < kSize; ++i) {
    const Estimate& one = found.report.estimates[i];
    EXPECT_LT(one.low_95, truth[i]) << one.info.symbol;
    EXPECT_GT(one.high_95, truth[i]) << one.info.symbol;
  }
  EXPECT_NEAR(found.report.estimates[kGain].refined, 1.03, 0.003);
}

TEST(OwnMeasurementDeathTest, WithoutABoxAndAStartIsAMistakeOfTheProgram) {
  const GainProblem gain = MadeProblem(1);
  const GainModel model(gain);
  const EstimateProblem problem{model, MakeEstimates(gain.infos, gain.lower, gain.upper)};
  EXPECT_DEATH(EstimateParameters(problem, {}, {}), "needs a start");
}

}  // namespace
}  // namespace lyrefit
