#include "lyrefit/diagnose/select.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "diagnose/synthetic_diagnosis.h"
#include "lyrefit/diagnose/values.h"
#include "synthetic_data.h"

namespace lyrefit {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

struct Selected {
  SyntheticData made;
  SelectOptions options;
  Selection selection;

  std::vector<std::string> Ids() const {
    std::vector<std::string> ids;
    for (const ChosenCause& cause : selection.causes) ids.push_back(cause.effect->id);
    return ids;
  }
};

Selected SelectFor(const IvCurve& curve, SelectOptions options = {}) {
  Selected selected;
  selected.made = OnTheData(curve);
  const Measurement& measurement = selected.made.measurement;
  if (options.candidates.empty()) options.candidates = Showable(measurement.readings.traits);
  selected.options = options;
  const std::vector<char> used(measurement.readings.points.size(), 1);
  selected.selection = SelectCauses(measurement, used, 0, options);
  return selected;
}

TEST(SelectCausesTest, FindsNothingInNoise) {
  int found = 0;
  for (int seed = 1; seed <= 10; ++seed) {
    Recipe recipe;
    recipe.seed = seed;
    const Selected selected = SelectFor(SyntheticCurve(recipe));
    const Selection& selection = selected.selection;
    ASSERT_TRUE(selection.base.usable);
    found += !selection.causes.empty() || !selection.outliers.empty() || selection.incomplete > 0.5;
    if (!selection.causes.empty()) continue;
    EXPECT_TRUE(selection.extended.law.effects.empty());
    EXPECT_GT(selection.none, 0.5);
  }
  EXPECT_LE(found, 1);
}

TEST(SelectCausesTest, FindsAStepOfTheLight) {
  const Selected selected = SelectFor(CurveWithAStep());
  const Selection& selection = selected.selection;
  EXPECT_THAT(selected.Ids(), ElementsAre("irr_step"));
  ASSERT_EQ(selection.extended.p.size(), 7U);
  EXPECT_NEAR(selection.extended.p[5], 0.015, 0.002);
  const Readings& readings = selected.made.measurement.readings;
  EXPECT_GT(selection.extended.p[6], readings.points[25].x);
  EXPECT_LT(selection.extended.p[6], readings.points[26].x);
  EXPECT_LT(selection.extended.sum, selection.base.sum);
  EXPECT_LT(selection.none, 1e-6);
}

TEST(SelectCausesTest, CausesStandInTheOrderOfTheLaw) {
  IvCurve curve = CurveWithAStep();
  for (double& i : curve.current_A) i = std::min(i, 7.98);
  const Selected selected = SelectFor(curve);
  const auto& effects = selected.selection.extended.law.effects;
  ASSERT_EQ(selected.selection.causes.size(), effects.size());
  for (std::size_t k = 0; k < effects.size(); ++k) {
    EXPECT_EQ(selected.selection.causes[k].effect, effects[k]);
  }
  EXPECT_THAT(selected.Ids(), Contains("clip"));
}

TEST(SelectCausesTest, LeavesAWrongReadingOut) {
  IvCurve curve = SyntheticCurve({});
  curve.current_A[17] -= 0.09;
  const Selection selection = SelectFor(curve).selection;
  EXPECT_THAT(selection.outliers, ElementsAre(17));
  EXPECT_THAT(selection.causes, IsEmpty());
  EXPECT_EQ(selection.weighted.used[17], 0);
}

// Of a table by hand Voc was read later, on a colder module. No substring is open because of it.
TEST(SelectCausesTest, ALastReadingThatAloneIsOffIsWrong) {
  Recipe recipe;
  recipe.cells = 36;
  recipe.points = 24;
  recipe.to_V = 0.6;
  IvCurve curve = SyntheticCurve(recipe);
  curve.voltage_V.push_back(1.07 * 36 * 0.613);
  curve.current_A.push_back(0);
  SelectOptions options;
  options.floors = {0.0025, 0.005};
  const Selection selection = SelectFor(curve, options).selection;
  EXPECT_THAT(selection.outliers, ElementsAre(24));
  EXPECT_THAT(selection.causes, IsEmpty());
}

// What the directions of a hysteretic device differ by is not described to the last: a start that
// settles beside it is no drift of the light.
TEST(SelectCausesTest, WhatIsSmallBesideHysteresisIsNoCause) {
  Recipe up, down;
  up.points = down.points = 50;
  IvCurve curve = SyntheticCurve(up);
  const IvCurve back = SyntheticCurve(down);
  const auto n = static_cast<int>(curve.size());
  for (int k = 0; k < n; ++k) {
    const double bent = 1 - 0.3 * std::pow(curve.voltage_V[k] / 0.645, 2);
    curve.current_A[k] = curve.current_A[k] * bent + 0.3 * std::exp(-k / 6.0);
  }
  for (int k = n - 1; k >= 0; --k) {
    curve.voltage_V.push_back(back.voltage_V[k]);
    curve.current_A.push_back(back.current_A[k]);
  }
  for (int k = 0; k < 2 * n; ++k) curve.sweep.push_back(k < n ? 0 : 1);
  SelectOptions options;
  options.floors = {0.0025, 0.005};
  const Selected selected = SelectFor(curve, options);
  EXPECT_THAT(selected.Ids(), ElementsAre("hysteresis"));
}

// The limit is read off the values; clipped readings are excluded from the fit.
TEST(SelectCausesTest, TakesClippingFromTheValues) {
  IvCurve curve = SyntheticCurve({});
  for (double& i : curve.current_A) i = std::min(i, 7.9);
  const Selected selected = SelectFor(curve);
  EXPECT_THAT(selected.Ids(), ElementsAre("clip"));
  EXPECT_NEAR(selected.selection.extended.p[5] * selected.made.measurement.readings.scale.current_A,
              7.9, 1e-9);
  for (const int k : selected.made.measurement.values.clipped)
    EXPECT_EQ(selected.selection.weighted.used[k], 0);
}

TEST(SelectCausesTest, TriesEveryCandidateOnTheBaseModel) {
  const Selected selected = SelectFor(CurveWithAStep());
  for (const Effect* effect : selected.options.candidates) {
    const auto of = [&](const FittedCandidate& fitted) { return fitted.score.effect == effect; };
    const auto& trials = selected.selection.trials.candidates;
    EXPECT_EQ(std::count_if(trials.begin(), trials.end(), of), 1) << effect->id;
  }
}

TEST(SelectCausesTest, OnlyCandidatesAreNamed) {
  SelectOptions options;
  options.candidates = {FindEffect("drift"), FindEffect("transient")};
  for (const std::string& id : SelectFor(CurveWithAStep(), options).Ids()) {
    EXPECT_TRUE(id == "drift" || id == "transient") << id;
  }
}

TEST(SelectCausesTest, NamesNoMoreThanAsked) {
  IvCurve curve = CurveWithAStep();
  for (std::size_t k = 0; k < curve.size(); ++k) {
    curve.current_A[k] += 0.15 * std::sin(0.6 * k);  // no effect of the catalogue has this shape
  }
  SelectOptions options;
  options.largest_causes = 2;
  EXPECT_LE(SelectFor(curve, options).selection.causes.size(), 2U);
}

// Findings of a sweep whose light steps by 0.8 A of 8 A and dips by `dip_A` earlier.
std::vector<std::string> StepAndDip(double dip_A, const Floors& floors) {
  IvCurve curve = SyntheticCurve({});
  for (std::size_t k = 26; k < curve.size(); ++k) curve.current_A[k] += 0.8;
  for (int k = 8; k < 16; ++k) curve.current_A[k] -= dip_A;
  SelectOptions options;
  options.floors = floors;
  std::vector<std::string> findings;
  for (const ChosenCause& cause : SelectFor(curve, options).selection.causes) {
    findings.emplace_back(cause.effect->Finding());
  }
  return findings;
}

// With floors, as in the field, causes are described in part only: what is small beside a large
// step may be how that step is in detail.
TEST(SelectCausesTest, WhatIsSmallBesideUnlikeCellsIsNoCause) {
  const Floors floors = {0.0025, 0.005};
  EXPECT_THAT(StepAndDip(0.1, {}), UnorderedElementsAre("irr_step", "transient"));
  EXPECT_THAT(StepAndDip(0.1, floors), ElementsAre("irr_step"));
  EXPECT_THAT(StepAndDip(1, floors), UnorderedElementsAre("irr_step", "transient"));
}

TEST(FindAlternativesTest, ListsWhatCouldStandInACausesPlace) {
  Selected selected = SelectFor(CurveWithAStep());
  FindAlternatives(selected.made.measurement, selected.options, &selected.selection);
  ASSERT_FALSE(selected.selection.causes.empty());
  const ChosenCause& cause = selected.selection.causes.front();
  ASSERT_FALSE(cause.others.candidates.empty());
  EXPECT_STREQ(cause.others.candidates.front().score.effect->id, "irr_step");
  EXPECT_GT(cause.probability, 0.9);
  double sum = cause.others.none.probability;
  for (const FittedCandidate& other : cause.others.candidates) sum += other.probability;
  EXPECT_NEAR(sum, 1, 1e-9);
  EXPECT_NEAR(cause.others.none.fit.sum, selected.selection.base.sum,
              0.5 * selected.selection.base.sum);
}

// In the first sweep, charging raises the current; in the second sweep it does not. Sorted by
// voltage, the currents of both would rise and fall.
TEST(LightMovedTest, SaysNothingOfTwoSweeps) {
  for (const bool both : {false, true}) {
    Recipe recipe;
    recipe.cells = 60;
    recipe.and_back = both;
    IvCurve curve = SyntheticCurve(recipe);
    EXPECT_FALSE(LightMoved(*OnTheData(curve).weighted.readings));
    for (std::size_t k = 0; k < curve.size(); ++k) {
      curve.current_A[k] *= 1 + 0.004 * static_cast<double>(std::min<std::size_t>(k, 15));
    }
    EXPECT_EQ(LightMoved(*OnTheData(curve).weighted.readings), !both);
  }
}

TEST(SelectCausesTest, ACurrentThatRisesWithTheVoltageNeedsAnEffectOfTheSweep) {
  Recipe recipe;
  recipe.cells = 60;
  IvCurve curve = SyntheticCurve(recipe);
  for (std::size_t k = 0; k < curve.size(); ++k) {
    curve.current_A[k] *= 0.9 + 0.1 * static_cast<double>(k) / static_cast<double>(curve.size());
  }
  const Selection selection = SelectFor(curve).selection;
  ASSERT_FALSE(selection.causes.empty());
  EXPECT_EQ(selection.causes.front().effect->where, Where::kSweep);
}

}  // namespace
}  // namespace lyrefit
