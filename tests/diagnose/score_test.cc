#include "lyrefit/diagnose/score.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "repeats.h"
#include "synthetic_data.h"

namespace lyrefit {
namespace {

constexpr int kDraws = 1000;

// Scores of every effect under the linear null hypothesis: the fitted currents of one curve with
// fresh noise.
class NullTest : public ::testing::Test {
 protected:
  void SetUp() override {
    Recipe recipe;
    recipe.points = 50;
    synthetic_ = OnTheData(SyntheticCurve(recipe));
    clean_ = FitBase(synthetic_.weighted, Law());
  }

  std::vector<Score> Draw(int seed) {
    Readings readings = synthetic_.measurement.readings;
    RandomStream random(seed, 5);
    for (std::size_t k = 0; k < readings.points.size(); ++k) {
      readings.points[k].current =
          clean_.current[k] + synthetic_.weighted.sigma[k] * random.Normal();
    }
    WeightedData weighted = synthetic_.weighted;
    weighted.readings = std::make_shared<const Readings>(std::move(readings));
    const LawFit fit = FitLaw(weighted, Law(), clean_.p);
    return ScoreEffects(weighted, fit, Showable(weighted.readings->traits), kDraws, 100 + seed);
  }

  SyntheticData synthetic_;
  LawFit clean_;
};

// Kolmogorov distance of the p-values from a uniform distribution.
double DistanceFromUniform(std::vector<double> p) {
  std::sort(p.begin(), p.end());
  double distance = 0;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const double count = static_cast<double>(p.size());
    distance = std::max({distance, p[k] - k / count, (k + 1) / count - p[k]});
  }
  return distance;
}

TEST_F(NullTest, PValuesOfNoiseAreUniform) {
  SKIP_IF_SANITIZED();
  constexpr int kCurves = 200;
  std::map<std::string, std::vector<double>> by_effect;
  std::vector<double> smallest;
  for (int seed = 1; seed <= kCurves; ++seed) {
    double corrected = 1;
    for (const Score& score : Draw(seed)) {
      if (!score.testable) continue;
      // A one-sided effect with an estimate of the wrong sign has the p-value 1.
      if (score.statistic > 0) by_effect[score.effect->id].push_back(score.p_value);
      EXPECT_GE(score.corrected_p, score.p_value);
      EXPECT_LE(score.corrected_p, 1);
      corrected = std::min(corrected, score.corrected_p);
    }
    smallest.push_back(corrected);
  }
  // Kolmogorov's bound at 1e-4 is 2.2 / sqrt(count).
  for (const char* id : {"outliers", "transient", "unknown_structure", "irr_step"}) {
    const std::vector<double>& p = by_effect[id];
    ASSERT_EQ(p.size(), static_cast<std::size_t>(kCurves)) << id;
    EXPECT_LT(DistanceFromUniform(p), 2.2 / std::sqrt(kCurves)) << id;
  }
  const auto below = [&](double level) {
    return std::count_if(smallest.begin(), smallest.end(), [=](double p) { return p < level; });
  };
  EXPECT_LT(DistanceFromUniform(smallest), 2.2 / std::sqrt(kCurves));
  EXPECT_LE(below(0.05), 24);  // 10 are expected; more than 24 have a probability of 1e-4
  EXPECT_GE(below(0.5), 70);
}

TEST_F(NullTest, TheSameSeedScoresTheSame) {
  const std::vector<Score> one = Draw(3), two = Draw(3);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    EXPECT_EQ(one[k].p_value, two[k].p_value);
    EXPECT_EQ(one[k].corrected_p, two[k].corrected_p);
    EXPECT_EQ(one[k].statistic, two[k].statistic);
  }
}

const Score& Of(const std::vector<Score>& scores, const std::string& id) {
  for (const Score& score : scores) {
    if (id == score.effect->id) return score;
  }
  ADD_FAILURE() << id;
  return scores.front();
}

std::vector<Score> ScoreCurve(const IvCurve& curve) {
  const SyntheticData made = OnTheData(curve);
  return ScoreEffects(made.weighted, FitBase(made.weighted, Law()),
                      Showable(made.measurement.readings.traits), kDraws, 1);
}

TEST(ScoreTest, SeesAWrongReading) {
  IvCurve curve = SyntheticCurve({});
  curve.current_A[23] += 0.06;
  const std::vector<Score> scores = ScoreCurve(curve);
  EXPECT_EQ(Of(scores, "outliers").outlier, 23);
  EXPECT_LT(Of(scores, "outliers").corrected_p, 1e-4);
}

TEST(ScoreTest, SeesAStepOfTheLight) {
  IvCurve curve = SyntheticCurve({});
  for (std::size_t k = 30; k < curve.size(); ++k) curve.current_A[k] += 0.08;
  const std::vector<Score> scores = ScoreCurve(curve);
  EXPECT_LT(Of(scores, "irr_step").corrected_p, 1e-4);
  EXPECT_GT(Of(scores, "irr_step").statistic, Of(scores, "second_diode").statistic);
}

// An effect that the base model absorbs is not testable, and the reason is stated.
TEST(ScoreTest, SaysWhatCannotBeSeen) {
  for (const Score& score : ScoreCurve(SyntheticCurve({}))) {
    EXPECT_EQ(score.testable, score.why_not.empty()) << score.effect->id;
    EXPECT_GE(score.kept, 0);
    EXPECT_LE(score.kept, 1 + 1e-9);
    if (!score.testable || score.directions.empty()) continue;
    for (const Direction& direction : score.directions) EXPECT_GT(direction.norm, 0);
  }
}

TEST(ScoreTest, CorrectedPFallsWithTheStatistic) {
  Score score;
  score.catalogue = 12;
  score.charge = 3;
  double last = 1;
  for (const double statistic : {0.0, 1.0, 10.0, 30.0, 100.0, 1e6}) {
    const double p = CorrectedP(score, statistic, 50, {});
    EXPECT_LE(p, last);
    EXPECT_GT(p, 0);
    last = p;
  }
  EXPECT_LT(last, 1e-20);
}

TEST(CalibrationTest, AnEmptyOneChangesNothing) {
  for (const double p : {1e-12, 0.01, 0.4, 1.0}) EXPECT_EQ(Calibration().Corrected(p), p);
}

TEST(CalibrationTest, KeepsTheOrderAndStaysAProbability) {
  Calibration calibration;
  for (int k = 0; k < 200; ++k)
    calibration.null_statistics.push_back(-1.3 * std::log(1 - (k + 0.5) / 200));
  double last = 0;
  for (const double p : {1e-30, 1e-12, 1e-6, 1e-3, 0.01, 0.05, 0.2, 0.5, 1.0}) {
    const double corrected = calibration.Corrected(p);
    EXPECT_GE(corrected, last);
    EXPECT_LE(corrected, 1);
    EXPECT_GE(corrected, 0.99 * p);  // these null_statistics are larger than the theoretical ones
    last = corrected;
  }
}

TEST(SignatureOfEffectTest, IsWhatTheProbesDo) {
  const SyntheticData made = OnTheData(SyntheticCurve({}));
  const Readings& readings = made.measurement.readings;
  const LawFit fit = FitBase(made.weighted, Law());
  const Effect& drift = *FindEffect("drift");
  Signatures signatures;
  const Eigen::MatrixXd moved =
      FindSignature(made.weighted, fit, {&drift}, &signatures)->moved.at(&drift);
  const std::vector<Probe> probes = drift.probes(readings.traits);
  ASSERT_EQ(moved.cols(), static_cast<int>(probes.size()));
  Law law;
  law.effects = {&drift};
  LawWorkspace workspace;
  std::vector<double> p = fit.p, current(readings.points.size());
  p.insert(p.end(), probes.front().begin(), probes.front().end());
  ASSERT_TRUE(EvaluateLaw(law, readings, p.data(), &workspace, current.data(), nullptr));
  for (std::size_t k = 0; k < current.size(); ++k) {
    EXPECT_NEAR(moved(static_cast<int>(k), 0), current[k] - fit.current[k], 1e-9);
  }
}

TEST(SignatureOfEffectTest, ServesFitsOfTheSameLawWithinTheNoise) {
  const SyntheticData made = OnTheData(SyntheticCurve({}));
  LawFit fit = FitBase(made.weighted, Law());
  const Effect *drift = FindEffect("drift"), *step = FindEffect("irr_step");
  Signatures signatures;
  const auto first = FindSignature(made.weighted, fit, {drift}, &signatures);
  for (double& current : fit.current) current += 0.5 * made.weighted.sigma.front();
  EXPECT_EQ(FindSignature(made.weighted, fit, {drift}, &signatures), first);
  EXPECT_NE(FindSignature(made.weighted, fit, {drift, step}, &signatures), first);
  for (double& current : fit.current) current += made.weighted.sigma.front();
  EXPECT_NE(FindSignature(made.weighted, fit, {drift}, &signatures), first);
  fit.law.effects = {step};
  fit.p.insert(fit.p.end(), {0.0, 0.0});
  EXPECT_NE(FindSignature(made.weighted, fit, {drift}, &signatures), first);
}

}  // namespace
}  // namespace lyrefit
