#include "lyrefit/diagnose/fit_effect.h"

#include <gtest/gtest.h>

#include <string>

#include "synthetic_data.h"

namespace lyrefit {
namespace {

const Score& Of(const std::vector<Score>& scores, const std::string& id) {
  for (const Score& score : scores) {
    if (id == score.effect->id) return score;
  }
  ADD_FAILURE() << id;
  return scores.front();
}

std::vector<Score> ScoreCurve(const IvCurve& curve) {
  const SyntheticData made = OnTheData(curve);
  Signatures signatures;
  return ScoreEffects(made.weighted, FitBase(made.weighted, Law()),
                      Showable(made.measurement.readings.traits), &signatures);
}

TEST(ScoreTest, SeesAWrongReading) {
  IvCurve curve = SyntheticCurve({});
  curve.current_A[23] += 0.06;
  const std::vector<Score> scores = ScoreCurve(curve);
  EXPECT_EQ(Of(scores, "outliers").outlier, 23);
  EXPECT_GT(Of(scores, "outliers").statistic, 25);
}

TEST(ScoreTest, SeesAStepOfTheLight) {
  IvCurve curve = SyntheticCurve({});
  for (std::size_t k = 30; k < curve.size(); ++k) curve.current_A[k] += 0.08;
  const std::vector<Score> scores = ScoreCurve(curve);
  EXPECT_GT(Of(scores, "irr_step").statistic, 25);
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

TEST(SignatureOfEffectTest, IsWhatTheProbesDo) {
  const SyntheticData made = OnTheData(SyntheticCurve({}));
  const Readings& readings = made.measurement.readings;
  const LawFit fit = FitBase(made.weighted, Law());
  const Effect& drift = *FindEffect("drift");
  Signatures signatures;
  const Eigen::MatrixXd moved =
      FindSignatures(made.weighted, fit, {&drift}, &signatures)->moved.at(&drift);
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
  const auto first = FindSignatures(made.weighted, fit, {drift}, &signatures);
  for (double& current : fit.current) current += 0.5 * made.weighted.sigma.front();
  EXPECT_EQ(FindSignatures(made.weighted, fit, {drift}, &signatures), first);
  EXPECT_NE(FindSignatures(made.weighted, fit, {drift, step}, &signatures), first);
  for (double& current : fit.current) current += made.weighted.sigma.front();
  EXPECT_NE(FindSignatures(made.weighted, fit, {drift}, &signatures), first);
  fit.law.effects = {step};
  fit.p.insert(fit.p.end(), {0.0, 0.0});
  EXPECT_NE(FindSignatures(made.weighted, fit, {drift}, &signatures), first);
}

}  // namespace
}  // namespace lyrefit
