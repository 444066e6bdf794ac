#include "lyrefit/estimate/refine/spread.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "estimate/refine/test_curves.h"
#include "family/synthetic_family.h"
#include "lyrefit/estimate/refine/coordinates.h"
#include "lyrefit/estimate/refine/refine.h"
#include "lyrefit/family/joint.h"

namespace lyrefit {
namespace {

constexpr double kNoise_A = 1e-3;

struct Scatter {
  double sum = 0, squares = 0, claimed = 0;
  int count = 0;
  void Add(double error, double standard_error) {
    sum += error;
    squares += error * error;
    claimed += standard_error;
    ++count;
  }
  double Ratio() const {
    const double mean = sum / count;
    return claimed / count / std::sqrt(squares / count - mean * mean);
  }
};

TEST(FindJointSpread, IsTheScatterOfRepeatedMeasurements) {
  const Translation law = SyntheticLaw(TranslationLaw::kDeSoto);
  const std::vector<double> truth = SyntheticTruth(law);
  constexpr int kRepeats = 250;
  std::vector<Scatter> shared(law.size());
  Scatter irradiance, temperature, prior;
  for (int run = 0; run < kRepeats; ++run) {
    RandomStream random(1000, run);
    const double off_K = 0.5 * random.Normal();
    CurveSet set = SyntheticSet(law, truth, kSixPlaces, 12, kNoise_A, run);
    JointProblem problem = SyntheticProblem(set, law, truth);
    problem.noise_A = kNoise_A;
    problem.curves[1].irradiance_sd = HUGE_VAL;
    problem.curves[2].temperature_sd_K = HUGE_VAL;
    problem.curves[3].temperature_sd_K = 0.5;
    problem.curves[3].temperature_K -= off_K;
    const JointEnd end = RefineJointly(problem, PointAt(problem, truth));
    const JointSpread spread = FindJointSpread(problem, end, kNoise_A * kNoise_A);
    for (int i = 0; i < law.size(); ++i) {
      if (!end.active[i]) shared[i].Add(end.point.shared[i] - truth[i], spread.standard_error[i]);
    }
    irradiance.Add(end.point.local[1][0], spread.local_errors[1][0]);
    temperature.Add(end.point.local[2][1], spread.local_errors[2][1]);
    prior.Add(end.point.local[3][1] - off_K, spread.local_errors[3][1]);
    EXPECT_GT(spread.local_degrees, 2);
    EXPECT_LT(spread.local_degrees, 3);
    EXPECT_TRUE(std::isnan(spread.local_errors[0][0]));
  }
  for (int i = 0; i < law.size(); ++i) {
    if (shared[i].count == 0) continue;
    EXPECT_NEAR(shared[i].Ratio(), 1, 0.15) << law.parameters[i].name;
  }
  EXPECT_NEAR(irradiance.Ratio(), 1, 0.15);
  EXPECT_NEAR(temperature.Ratio(), 1, 0.15);
  EXPECT_NEAR(prior.Ratio(), 1, 0.15);
}

// Expects the standard errors with parameters `open` free to equal those with `open` fixed, and NaN
// for `open`.
void ExpectOnlyOpen(const JointProblem& problem, const std::vector<double>& truth,
                    const std::vector<int>& open) {
  const JointEnd end = RefineJointly(problem, PointAt(problem, truth));
  const JointSpread spread = FindJointSpread(problem, end, 1);
  JointEnd without = end;
  for (const int i : open) without.active[i] = true;
  const JointSpread expected = FindJointSpread(problem, without, 1);
  for (int i = 0; i < problem.translation.size(); ++i) {
    const std::string& name = problem.translation.parameters[i].name;
    if (without.active[i]) {
      EXPECT_TRUE(std::isnan(spread.standard_error[i])) << name;
    } else {
      EXPECT_GT(spread.standard_error[i], 0) << name;
      EXPECT_NEAR(spread.standard_error[i] / expected.standard_error[i], 1, 1e-6) << name;
    }
  }
}

TEST(FindJointSpread, LosesOnlyWhatTheDataDoNotShow) {
  const Translation desoto = SyntheticLaw(TranslationLaw::kDeSoto);
  const std::vector<double> truth = SyntheticTruth(desoto);
  const CurveSet one_temperature =
      SyntheticSet(desoto, truth, {{1000, 25}, {500, 25}, {200, 25}}, 15, kNoise_A);
  ExpectOnlyOpen(SyntheticProblem(one_temperature, desoto, truth), truth,
                 {desoto.alpha_sc, desoto.bandgap});
  const Translation pvsyst = SyntheticLaw(TranslationLaw::kPvsyst);
  const std::vector<double> other = SyntheticTruth(pvsyst);
  const CurveSet one_sun =
      SyntheticSet(pvsyst, other, {{1000, 25}, {1000, 45}, {1000, 65}}, 15, kNoise_A);
  ExpectOnlyOpen(SyntheticProblem(one_sun, pvsyst, other), other, {pvsyst.resistance_shunt_dark});
}

TEST(FindJointSpread, LosesWhatTradesPlacesWithoutATrace) {
  // At one temperature other than the reference, photocurrent and alpha act as one parameter.
  const Translation law = SyntheticLaw(TranslationLaw::kDeSoto);
  const std::vector<double> truth = SyntheticTruth(law);
  const JointProblem problem =
      SyntheticProblem(SyntheticSet(law, truth, {{1000, 45}, {500, 45}}, 20, kNoise_A), law, truth);
  const JointEnd end = RefineJointly(problem, PointAt(problem, truth));
  const JointSpread spread = FindJointSpread(problem, end, 1);
  for (const int i : {law.photocurrent, law.alpha_sc, law.saturation_current, law.bandgap}) {
    EXPECT_TRUE(std::isnan(spread.standard_error[i])) << law.parameters[i].name;
  }
  for (const int i : {law.n, law.resistance_series, law.resistance_shunt}) {
    EXPECT_GT(spread.standard_error[i], 0) << law.parameters[i].name;
  }
}

TEST(FindJointSpread, LosesTheScaleOfIrradianceWhereEveryCurveHasItsOwn) {
  const Translation law = SyntheticLaw(TranslationLaw::kPvsyst);
  const std::vector<double> truth = SyntheticTruth(law);
  JointProblem problem =
      SyntheticProblem(SyntheticSet(law, truth, kSixPlaces, 20, kNoise_A), law, truth);
  problem.lower[law.resistance_shunt_dark] = problem.upper[law.resistance_shunt_dark] = 900;
  problem.lower[law.resistance_shunt] = problem.upper[law.resistance_shunt] = 900;
  for (JointCurve& curve : problem.curves) curve.irradiance_sd = HUGE_VAL;
  std::vector<double> start = truth;
  start[law.resistance_shunt] = 900;
  const JointEnd end = RefineJointly(problem, PointAt(problem, start));
  const JointSpread spread = FindJointSpread(problem, end, 1);
  EXPECT_TRUE(std::isnan(spread.standard_error[law.photocurrent]));
  EXPECT_TRUE(std::isnan(spread.standard_error[law.alpha_sc]));
  EXPECT_GT(spread.standard_error[law.n], 0);
  for (const JointLocal& error : spread.local_errors) EXPECT_TRUE(std::isnan(error[0]));
}

TEST(FindSpread, IsTheScatterOfRepeatedMeasurements) {
  constexpr int kRepeats = 400;
  std::vector<double> mean(5), square(5), claimed(5);
  for (int run = 0; run < kRepeats; ++run) {
    const RefineProblem problem = ModuleProblem(Model::kSingleDiode, Model::kSingleDiode,
                                                kSingleTruth, 1e-3, Objective::kSolvedCurrent, run);
    const RefineEnd end = Refine(problem, kSingleTruth);
    const Spread spread = SpreadOf(problem, end, 35);
    for (int i = 0; i < 5; ++i) {
      mean[i] += end.p[i] / kRepeats;
      square[i] += end.p[i] * end.p[i] / kRepeats;
      claimed[i] += spread.standard_error[i] / kRepeats;
    }
  }
  for (int i = 0; i < 5; ++i) {
    const double scatter = std::sqrt(square[i] - mean[i] * mean[i]);
    EXPECT_NEAR(claimed[i] / scatter, 1, 0.15) << i;
    EXPECT_NEAR(mean[i], kSingleTruth[i],
                5 * scatter / std::sqrt(kRepeats) + 0.02 * kSingleTruth[i])
        << i;
  }
}

TEST(FindSpread, UnderOtherErrorsIsTheSandwich) {
  const RefineProblem problem = ModuleProblem(Model::kSingleDiode, Model::kSingleDiode,
                                              kSingleTruth, 1e-3, Objective::kSolvedCurrent);
  const RefineEnd end = Refine(problem, kSingleTruth);
  const CurveModel model(problem);
  const Spread plain = FindSpread(model, end, end.active, 4e-6);
  const Spread same = FindSpread(model, end, end.active,
                                 [](const RowMatrix& rows) { return RowMatrix(4e-6 * rows); });
  // A single error of the shape `ramp` shifts the parameters by its projection; the standard errors
  // are these shifts.
  const Linearization now = Linearize(model, end, end.active);
  const Eigen::MatrixXd inverse = (now.jacobian.transpose() * now.jacobian).inverse();
  Eigen::VectorXd ramp = Eigen::VectorXd::LinSpaced(now.residual.size(), 0, 1e-3);
  const Spread one = FindSpread(model, end, end.active, [&](const RowMatrix& rows) {
    return RowMatrix(ramp * (ramp.transpose() * rows) + 1e-20 * rows);
  });
  const Eigen::VectorXd moved = now.natural_slope * (inverse * (now.jacobian.transpose() * ramp));
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(same.standard_error[i] / plain.standard_error[i], 1, 1e-9) << i;
    EXPECT_NEAR(one.standard_error[i] / std::fabs(moved[i]), 1, 1e-4) << i;
  }
}

TEST(FindSpread, SaysNothingOfHeldParameters) {
  RefineProblem problem = ModuleProblem(Model::kSingleDiode, Model::kSingleDiode, kSingleTruth,
                                        1e-3, Objective::kSolvedCurrent);
  problem.lower[2] = problem.upper[2] = 1.2;
  const Spread spread = SpreadOf(problem, Refine(problem, kSingleTruth), 36);
  EXPECT_TRUE(std::isnan(spread.standard_error[2]));
  EXPECT_GT(spread.standard_error[1], 0);
}

}  // namespace
}  // namespace lyrefit
