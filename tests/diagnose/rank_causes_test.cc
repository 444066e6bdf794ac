#include "lyrefit/diagnose/rank_causes.h"

#include <gtest/gtest.h>

#include "synthetic_data.h"

namespace lyrefit {
namespace {

constexpr double kOrdinary = 1.2, kMisfit = 0.004, kFloor = 0.0025;

Recipe SweptModule(bool and_back = false) {
  Recipe recipe;
  recipe.cells = 60;
  recipe.and_back = and_back;
  return recipe;
}

// An effect with given parameter values beside an ordinary base model; its currents are not
// evaluated.
FittedCandidate FittedCandidateOf(const char* id, const std::vector<double>& values,
                                  double statistic, double n = kOrdinary) {
  FittedCandidate fitted;
  fitted.score.effect = FindEffect(id);
  fitted.statistic = statistic;
  fitted.fit.usable = true;
  fitted.fit.law.effects = {fitted.score.effect};
  fitted.fit.p = {1, 0, n, 0.015, 0.05};
  fitted.fit.p.insert(fitted.fit.p.end(), values.begin(), values.end());
  return fitted;
}

const std::vector<double> kShade = {0.3, 1.0 / 3, 0.5, 1}, kDip = {0.1, 0, 0.05, 0, 2},
                          kUnequal = {0.1, 0.2}, kLag = {0.001, 0, 0};

LawFit Before(double n = kOrdinary) {
  LawFit before;
  before.p = {1, 0, n, 0.015, 0.05};
  return before;
}

TEST(HasPossibleSize, RefusesWhatCannotBe) {
  const SyntheticData made = OnTheData(SyntheticCurve(SweptModule()));
  const Readings& readings = *made.weighted.readings;
  const auto possible = [&](const FittedCandidate& fitted, const LawFit& before = Before()) {
    return HasPossibleSize(readings, before, fitted);
  };
  EXPECT_TRUE(possible(FittedCandidateOf("temp_drift", {2}, 50)));
  EXPECT_FALSE(possible(FittedCandidateOf("temp_drift", {-12}, 50)));
  EXPECT_FALSE(possible(FittedCandidateOf("irr_step", {0.5, 0}, 50)));  // at its bound
  EXPECT_TRUE(possible(FittedCandidateOf("mismatch", kUnequal, 50)));
  // share of a third of one cell
  EXPECT_FALSE(possible(FittedCandidateOf("mismatch", {0.1, 0.006}, 50)));
  EXPECT_FALSE(possible(FittedCandidateOf("nonohmic_shunt", {0.1, 5}, 50)));
  EXPECT_FALSE(possible(FittedCandidateOf("mismatch", kUnequal, 50, 0.7)));
  EXPECT_TRUE(possible(FittedCandidateOf("mismatch", kUnequal, 50, 0.7), Before(0.6)));
  // The first of the darker substrings may reach the light of the brightest; a later one may not.
  EXPECT_TRUE(
      possible(FittedCandidateOf("substrings", {0, 0.3, 0.4, 0.3, 0, 0, 0, 0, 0.5, 1}, 50)));
  EXPECT_FALSE(possible(FittedCandidateOf("substrings", {0, 0.3, 0, 0.3, 0, 0, 0, 0, 0.5, 1}, 50)));
}

std::size_t Ranked(const SyntheticData& made,
                   const std::vector<FittedCandidate>& fitted_candidates) {
  return RankCauses(made.weighted, fitted_candidates, kMisfit, kFloor);
}

TEST(RankCauses, TakesTheDeviceBeforeAMomentThatExplainsAboutAsMuch) {
  const SyntheticData made = OnTheData(SyntheticCurve(SweptModule()));
  EXPECT_EQ(Ranked(made, {FittedCandidateOf("transient", kDip, 100),
                          FittedCandidateOf("mismatch", kUnequal, 92)}),
            1U);
  EXPECT_EQ(Ranked(made, {FittedCandidateOf("transient", kDip, 100),
                          FittedCandidateOf("mismatch", kUnequal, 80)}),
            0U);
}

TEST(RankCauses, TakesWhatLeavesAsLittleAndSupposesLess) {
  const SyntheticData made = OnTheData(SyntheticCurve(SweptModule()));
  const auto leaving = [](FittedCandidate fitted, double left) {
    fitted.left = left;
    return fitted;
  };
  const FittedCandidate dip = leaving(FittedCandidateOf("transient", kDip, 100), 0.001);
  const auto with = [&](const FittedCandidate& other) { return Ranked(made, {dip, other}); };
  EXPECT_EQ(with(leaving(FittedCandidateOf("mismatch", kUnequal, 70), 0.0012)), 1U);
  EXPECT_EQ(with(leaving(FittedCandidateOf("mismatch", kUnequal, 70), 0.0013)), 0U);
  // explains less than half as much
  EXPECT_EQ(with(leaving(FittedCandidateOf("mismatch", kUnequal, 40), 0.0005)), 0U);
}

TEST(RankCauses, TakesAPossibleIdealityBeforeOneThatOnlyBends) {
  const SyntheticData made = OnTheData(SyntheticCurve(SweptModule()));
  const FittedCandidate mismatch = FittedCandidateOf("mismatch", kUnequal, 92);
  const auto beside = [&](double n) {
    return Ranked(made, {FittedCandidateOf("distributed_rs", {0.05}, 100, n), mismatch});
  };
  EXPECT_EQ(beside(0.5), 1U);
  EXPECT_EQ(beside(kOrdinary), 0U);
}

TEST(RankCauses, OneDimCellIsAWeakCell) {
  const SyntheticData made = OnTheData(SyntheticCurve(SweptModule()));
  const std::vector<double> weak = {0.1, 1, 0, 0.5, 0.1, 15, 3.4, 3.2, 1};
  const auto beside = [&](double cells) {
    return Ranked(made, {FittedCandidateOf("mismatch", {0.1, cells / 60}, 100),
                         FittedCandidateOf("weak_cell", weak, 99)});
  };
  EXPECT_EQ(beside(1.2), 1U);
  EXPECT_EQ(beside(12), 0U);
}

TEST(RankCauses, TakesHysteresisBeforeADipOfSweepsUpAndDown) {
  const SyntheticData made = OnTheData(SyntheticCurve(SweptModule(/*and_back=*/true)));
  EXPECT_EQ(Ranked(made, {FittedCandidateOf("transient", kDip, 100),
                          FittedCandidateOf("capacitance", kLag, 80)}),
            1U);
  EXPECT_EQ(Ranked(made, {FittedCandidateOf("drift", {0.02}, 100),
                          FittedCandidateOf("capacitance", kLag, 80)}),
            0U);
}

TEST(RankCauses, TakesACloudBeforeARangeUnlessTwoSweepsTell) {
  const std::vector<double> range = {0.02, 0.6}, cloud = {0.02, 0};
  for (const bool both : {false, true}) {
    const SyntheticData made = OnTheData(SyntheticCurve(SweptModule(both)));
    const auto ranked_first = [&](double of_range, double of_cloud) {
      const FittedCandidate a = FittedCandidateOf("range_switch", range, of_range);
      const FittedCandidate b = FittedCandidateOf("irr_step", cloud, of_cloud);
      const std::size_t at = Ranked(made, of_range > of_cloud ? std::vector<FittedCandidate>{a, b}
                                                              : std::vector<FittedCandidate>{b, a});
      return (at == 0) == (of_range > of_cloud) ? "range_switch" : "irr_step";
    };
    EXPECT_STREQ(ranked_first(100, 80), both ? "range_switch" : "irr_step");
    EXPECT_STREQ(ranked_first(100, 105), both ? "range_switch" : "irr_step");
    EXPECT_STREQ(ranked_first(100, 40), "range_switch");
    EXPECT_STREQ(ranked_first(40, 100), "irr_step");
  }
}

// In the first sweep, charging raises the current; in the second sweep it does not. Sorted by
// voltage, the currents of both would rise and fall.
TEST(LightMoved, SaysNothingOfTwoSweeps) {
  for (const bool both : {false, true}) {
    IvCurve curve = SyntheticCurve(SweptModule(both));
    for (std::size_t k = 0; k < curve.size(); ++k) {
      curve.current_A[k] *= 1 + 0.004 * static_cast<double>(std::min<std::size_t>(k, 15));
    }
    EXPECT_EQ(LightMoved(*OnTheData(curve).weighted.readings), !both);
  }
}

TEST(RankCauses, TakesWhatSupposesLess) {
  const SyntheticData made = OnTheData(SyntheticCurve(SweptModule()));
  const std::vector<double> weak = {0.3, 1, 0, 0.5, 0.1, 15, 3.4, 3.2, 1};
  EXPECT_EQ(Ranked(made, {FittedCandidateOf("weak_cell", weak, 100),
                          FittedCandidateOf("shading", kShade, 99)}),
            1U);
  EXPECT_EQ(Ranked(made, {FittedCandidateOf("weak_cell", weak, 100),
                          FittedCandidateOf("shading", kShade, 70)}),
            0U);
}

TEST(RankCauses, KeepsTheComplexOneWhereItsCurveIsAnother) {
  const SyntheticData made = OnTheData(SyntheticCurve(SweptModule()));
  const std::vector<double> both = {0.3, 1. / 3, 0.6, 1. / 3, 0, 0, 0, 0, 0.5, 1};
  const std::vector<FittedCandidate> fitted_candidates = {
      FittedCandidateOf("substrings", both, 100), FittedCandidateOf("shading", kShade, 99)};
  // The simpler cause leaves a tenth of the misfit.
  EXPECT_EQ(RankCauses(made.weighted, fitted_candidates, 9 * kFloor, kFloor), 1U);
  EXPECT_EQ(RankCauses(made.weighted, fitted_candidates, 11 * kFloor, kFloor), 0U);
}

TEST(LightMoved, WhereTheCurrentRisesWithTheVoltage) {
  IvCurve curve = SyntheticCurve(SweptModule());
  EXPECT_FALSE(LightMoved(*OnTheData(curve).weighted.readings));
  for (std::size_t k = 0; k < curve.size() / 2; ++k) {
    curve.current_A[k] *= 0.9 + 0.1 * static_cast<double>(k) / (0.5 * curve.size());
  }
  const SyntheticData made = OnTheData(curve);
  EXPECT_TRUE(LightMoved(*made.weighted.readings));
  EXPECT_EQ(Ranked(made, {FittedCandidateOf("shading", kShade, 100),
                          FittedCandidateOf("drift", {0.1}, 40)}),
            1U);
}

}  // namespace
}  // namespace lyrefit
