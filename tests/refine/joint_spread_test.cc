#include <gtest/gtest.h>

#include <cmath>

#include "family/made_family.h"
#include "lyrefit/refine/joint_linear.h"
#include "lyrefit/refine/joint_profile.h"

namespace lyrefit {
namespace {

constexpr double kNoise_A = 1e-3;

JointPoint PointAt(const JointProblem& problem, std::vector<double> shared) {
  return {std::move(shared), std::vector<JointLocal>(problem.curves.size(), {0, 0})};
}

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
  const Translation law = MadeLaw(TranslationLaw::kDeSoto);
  const std::vector<double> truth = MadeTruth(law);
  constexpr int kRepeats = 250;
  std::vector<Scatter> shared(law.size());
  Scatter irradiance, temperature, prior;
  for (int run = 0; run < kRepeats; ++run) {
    RandomStream random(1000, run);
    const double off_K = 0.5 * random.Normal();
    CurveSet set = MadeSet(law, truth, kSixPlaces, 12, kNoise_A, run);
    JointProblem problem = MadeProblem(set, law, truth);
    problem.noise_A = kNoise_A;
    problem.curves[1].irradiance_sd = HUGE_VAL;
    problem.curves[2].temperature_sd_K = HUGE_VAL;
    problem.curves[3].temperature_sd_K = 0.5;
    problem.curves[3].temperature_K -= off_K;
    const JointEnd end = RefineJointly(problem, PointAt(problem, truth));
    const JointSpread spread = FindJointSpread(problem, end, kNoise_A * kNoise_A);
    for (int i = 0; i < law.size(); ++i) {
      if (!end.held[i]) shared[i].Add(end.point.shared[i] - truth[i], spread.standard_error[i]);
    }
    irradiance.Add(end.point.local[1][0], spread.local_error[1][0]);
    temperature.Add(end.point.local[2][1], spread.local_error[2][1]);
    prior.Add(end.point.local[3][1] - off_K, spread.local_error[3][1]);
    EXPECT_GT(spread.local_degrees, 2);
    EXPECT_LT(spread.local_degrees, 3);
    EXPECT_TRUE(std::isnan(spread.local_error[0][0]));
  }
  for (int i = 0; i < law.size(); ++i) {
    if (shared[i].count == 0) continue;
    EXPECT_NEAR(shared[i].Ratio(), 1, 0.15) << law.parameters[i].name;
  }
  EXPECT_NEAR(irradiance.Ratio(), 1, 0.15);
  EXPECT_NEAR(temperature.Ratio(), 1, 0.15);
  EXPECT_NEAR(prior.Ratio(), 1, 0.15);
}

// Standard errors with parameters `open` free are those with them held, and theirs are unknown.
void ExpectOnlyOpen(const JointProblem& problem, const std::vector<double>& truth,
                    const std::vector<int>& open) {
  const JointEnd end = RefineJointly(problem, PointAt(problem, truth));
  const JointSpread spread = FindJointSpread(problem, end, 1);
  JointEnd without = end;
  for (const int i : open) without.held[i] = true;
  const JointSpread expected = FindJointSpread(problem, without, 1);
  for (int i = 0; i < problem.translation.size(); ++i) {
    const std::string& name = problem.translation.parameters[i].name;
    if (without.held[i]) {
      EXPECT_TRUE(std::isnan(spread.standard_error[i])) << name;
    } else {
      EXPECT_GT(spread.standard_error[i], 0) << name;
      EXPECT_NEAR(spread.standard_error[i] / expected.standard_error[i], 1, 1e-6) << name;
    }
  }
}

TEST(FindJointSpread, LosesOnlyWhatTheDataDoNotShow) {
  const Translation desoto = MadeLaw(TranslationLaw::kDeSoto);
  const std::vector<double> truth = MadeTruth(desoto);
  const CurveSet one_temperature =
      MadeSet(desoto, truth, {{1000, 25}, {500, 25}, {200, 25}}, 15, kNoise_A);
  ExpectOnlyOpen(MadeProblem(one_temperature, desoto, truth), truth,
                 {desoto.alpha_sc, desoto.bandgap});
  const Translation pvsyst = MadeLaw(TranslationLaw::kPvsyst);
  const std::vector<double> other = MadeTruth(pvsyst);
  const CurveSet one_sun =
      MadeSet(pvsyst, other, {{1000, 25}, {1000, 45}, {1000, 65}}, 15, kNoise_A);
  ExpectOnlyOpen(MadeProblem(one_sun, pvsyst, other), other, {pvsyst.resistance_shunt_dark});
}

TEST(FindJointSpread, LosesWhatTradesPlacesWithoutATrace) {
  // At one temperature away from the reference photocurrent and alpha are one number.
  const Translation law = MadeLaw(TranslationLaw::kDeSoto);
  const std::vector<double> truth = MadeTruth(law);
  const JointProblem problem =
      MadeProblem(MadeSet(law, truth, {{1000, 45}, {500, 45}}, 20, kNoise_A), law, truth);
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
  const Translation law = MadeLaw(TranslationLaw::kPvsyst);
  const std::vector<double> truth = MadeTruth(law);
  JointProblem problem = MadeProblem(MadeSet(law, truth, kSixPlaces, 20, kNoise_A), law, truth);
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
  for (const JointLocal& error : spread.local_error) EXPECT_TRUE(std::isnan(error[0]));
}

TEST(FindJointProfileSide, EndsWhereTheRefittedSumOfSquaresReachesItsThreshold) {
  const Translation law = MadeLaw(TranslationLaw::kDeSoto);
  const std::vector<double> truth = MadeTruth(law);
  JointProblem problem = MadeProblem(MadeSet(law, truth, kSixPlaces, 12, 3e-3), law, truth);
  problem.curves[1].irradiance_sd = HUGE_VAL;
  const JointEnd best = RefineJointly(problem, PointAt(problem, truth));
  const double variance = 9e-6, t = 2;
  const JointSpread spread = FindJointSpread(problem, best, variance);
  const auto rise = [&](int i, double value) {
    JointProblem held = problem;
    held.lower[i] = held.upper[i] = value;
    const JointEnd end = RefineJointly(held, best.point);
    return std::sqrt((end.squares - best.squares) / variance);
  };
  for (int i = 0; i < law.size(); ++i) {
    if (best.held[i]) continue;
    for (const bool upper : {false, true}) {
      const JointProfileSide side = FindJointProfileSide(
          problem, best, {i, upper, t, variance, spread.standard_error[i], {}});
      EXPECT_EQ(side.value > best.point.shared[i], upper) << law.parameters[i].name;
      EXPECT_FALSE(side.at_bound) << law.parameters[i].name;
      EXPECT_NEAR(rise(i, side.value), t, 0.01 * t) << law.parameters[i].name;
      // Nothing on the way crosses the threshold.
      const double middle = 0.5 * (side.value + best.point.shared[i]);
      EXPECT_LT(rise(i, middle), t) << law.parameters[i].name;
    }
  }
}

TEST(FindJointProfileSide, StopsAtABoundThatTheDataAllow) {
  const Translation law = MadeLaw(TranslationLaw::kDeSoto);
  std::vector<double> truth = MadeTruth(law);
  truth[law.resistance_series] = 0;
  truth[law.resistance_shunt] = 1e7;
  const JointProblem problem = MadeProblem(MadeSet(law, truth, kSixPlaces, 12, 3e-3), law, truth);
  const JointEnd best = RefineJointly(problem, PointAt(problem, truth));
  const JointProfileSide low =
      FindJointProfileSide(problem, best, {law.resistance_series, false, 2, 9e-6, 0, {}});
  EXPECT_TRUE(low.at_bound);
  EXPECT_EQ(low.value, 0);
  EXPECT_TRUE(
      FindJointProfileSide(problem, best, {law.resistance_shunt, true, 2, 9e-6, 0, {}}).at_bound);
  const JointProfileSide limit =
      FindJointProfileSide(problem, best, {law.resistance_shunt, false, 2, 9e-6, 0, {}});
  EXPECT_FALSE(limit.at_bound);
  EXPECT_GT(limit.value, 300);
}

}  // namespace
}  // namespace lyrefit
