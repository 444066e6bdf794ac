#include "lyrefit/diagnose/experiment_design.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lyrefit/diagnose/diagnose.h"
#include "synthetic_data.h"

namespace lyrefit {
namespace {

using ::testing::IsEmpty;

FittedCandidate FittedCandidateOf(const char* id, double probability) {
  FittedCandidate fitted;
  fitted.score.effect = FindEffect(id);
  fitted.probability = probability;
  return fitted;
}

TEST(EquivalentsTest, HaveATwentiethOfTheProbability) {
  ChosenCause cause;
  cause.effect = FindEffect("drift");
  cause.probability = 0.4;
  cause.others.candidates = {FittedCandidateOf("shading", 0.5), FittedCandidateOf("drift", 0.4),
                             FittedCandidateOf("clip", 0.05), FittedCandidateOf("transient", 0.01)};
  const auto equivalents = EquivalentsOf(cause);
  ASSERT_EQ(equivalents.size(), 2U);
  EXPECT_STREQ(equivalents[0]->score.effect->id, "shading");
  EXPECT_STREQ(equivalents[1]->score.effect->id, "clip");
  EXPECT_EQ(OwnCandidate(cause), &cause.others.candidates[1]);
  cause.others = {};
  EXPECT_THAT(EquivalentsOf(cause), IsEmpty());
}

TEST(PlanCandidateTest, IsTheCauseWhereverItStandsInItsLaw) {
  const SyntheticData made = OnTheData(SyntheticCurve({}));
  FittedCandidate fitted = FittedCandidateOf("shading", 0.5);
  fitted.fit = FitBase(made.weighted, Law());
  fitted.fit.law.effects = {FindEffect("shading"), FindEffect("irr_step")};
  const int first = fitted.fit.law.Offset(0), behind = fitted.fit.law.Offset(1);
  fitted.fit.p.resize(fitted.fit.law.size(), 0.25);
  const PlanCandidate candidate = MakeCandidate(made.measurement.readings, fitted);
  EXPECT_STREQ(candidate.effect->id, "shading");
  for (const std::vector<double>& start : candidate.starts) {
    for (int k = 0; k < fitted.fit.law.size(); ++k) {
      if (k < first || k >= behind) EXPECT_EQ(start[k], fitted.fit.p[k]) << k;
    }
  }
}

DiagnoseOptions QuickWith(const std::vector<std::string>& effects) {
  DiagnoseOptions options;
  options.noise = ErrorSpec();
  options.floor_current = options.floor_power = 0;
  options.held_out = false;
  options.effects = effects;
  options.plan = true;
  return options;
}

// A cell with poor carrier collection, which loses a fraction of the photocurrent. On one lit
// sweep, a nonohmic shunt looks alike.
IvCurve CurveOfPoorCollection() {
  constexpr double kRs = 0.004, kSaturation = 1.2e-8, kThermal = 1.2 * 0.02569, kLoss = 0.04 * 8;
  IvCurve curve = SyntheticCurve({});
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const double v = curve.voltage_V[k] + kRs * curve.current_A[k];
    const double slope = kSaturation / kThermal * std::exp(v / kThermal);
    curve.current_A[k] -= kLoss / (0.9 - v) / (1 + kRs * slope);
  }
  return curve;
}

const PlannedMeasurement& Find(const Plan& plan, const std::string& id) {
  return *std::find_if(plan.measurements.begin(), plan.measurements.end(),
                       [&](const PlannedMeasurement& m) { return m.id == id; });
}

TEST(PlanTest, ADarkCurveTellsAShuntFromCollection) {
  const auto diagnosis =
      Diagnose(CurveOfPoorCollection(), QuickWith({"nonohmic_shunt", "collection"}));
  ASSERT_TRUE(diagnosis);
  ASSERT_TRUE(diagnosis->plan);
  const Plan& plan = *diagnosis->plan;
  ASSERT_EQ(plan.causes.size(), 2U);
  for (std::size_t k = 1; k < plan.measurements.size(); ++k) {
    EXPECT_GE(plan.measurements[k - 1].probability, plan.measurements[k].probability);
  }
  EXPECT_GT(Find(plan, "dark_curve").probability, 0.95);
  EXPECT_LT(Find(plan, "reverse_sweep").probability, Find(plan, "dark_curve").probability);
  EXPECT_EQ(plan.sentence.rfind("take ", 0), 0U);
}

TEST(PlanTest, IsTheSameOnAnyNumberOfThreads) {
  DiagnoseOptions options = QuickWith({"nonohmic_shunt", "collection"});
  options.threads = 1;
  const auto one = Diagnose(CurveOfPoorCollection(), options);
  options.threads = 3;
  const auto three = Diagnose(CurveOfPoorCollection(), options);
  ASSERT_TRUE(one && three);
  ASSERT_EQ(one->plan->measurements.size(), three->plan->measurements.size());
  for (std::size_t k = 0; k < one->plan->measurements.size(); ++k) {
    EXPECT_EQ(one->plan->measurements[k].id, three->plan->measurements[k].id);
    EXPECT_EQ(one->plan->measurements[k].probability, three->plan->measurements[k].probability);
  }
}

TEST(PlanTest, WhereOneCauseStandsAloneThereIsNothingToTell) {
  const auto diagnosis = Diagnose(CurveOfPoorCollection(), QuickWith({"collection"}));
  ASSERT_TRUE(diagnosis);
  EXPECT_THAT(diagnosis->plan->causes, IsEmpty());
  EXPECT_THAT(diagnosis->plan->measurements, IsEmpty());
}

TEST(PlanTest, IsThereOnlyWhereAskedFor) {
  DiagnoseOptions options = QuickWith({"collection"});
  options.plan = false;
  EXPECT_FALSE(Diagnose(CurveOfPoorCollection(), options)->plan);
}

}  // namespace
}  // namespace lyrefit
