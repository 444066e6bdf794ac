
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/diagnose/fit_effect.h"
#include "synthetic_data.h"

namespace lyrefit {
namespace {

// Whether an effect can be fitted to a curve.
bool Fits(const char* id, const IvCurve& curve) {
  const SyntheticData made = OnTheData(curve);
  const LawFit base = FitBase(made.weighted, Law());
  Signatures signatures;
  const std::vector<Score> scores =
      ScoreEffects(made.weighted, base, {FindEffect(id)}, &signatures);
  return FitEffect(made.weighted, base, scores.front()).usable;
}

// From reading 20 on the light is 5 % weaker, at once or over `readings`.
IvCurve Weaker(int readings) {
  IvCurve curve = SyntheticCurve({});
  for (int k = 20; k < static_cast<int>(curve.size()); ++k) {
    curve.current_A[k] -= 0.4 * std::min(1.0, (k - 19.0) / readings);
  }
  return curve;
}

TEST(ImitationTest, AStepOfTheLightJumps) {
  EXPECT_TRUE(Fits("irr_step", Weaker(1)));
  EXPECT_FALSE(Fits("irr_step", Weaker(12)));
}

// The edge of a cloud over a tenth of the sweep; in the knee a device bends, and where a bypass group
// ends it may be shade.
TEST(ImitationTest, ACloudStaysOffKneeAndBypassSteps) {
  const auto fits = [](double part, int bypass_diodes) {
    Recipe recipe;
    recipe.points = 120;
    recipe.cells = 60;
    IvCurve curve = SyntheticCurve(recipe);
    curve.notes.bypass_diodes = bypass_diodes;
    const auto voc = std::find_if(curve.current_A.begin(), curve.current_A.end(),
                                  [](double current) { return current < 0; });
    const double centre = part * static_cast<double>(voc - curve.current_A.begin());
    for (int k = 0; k < static_cast<int>(curve.size()); ++k) {
      const double passed = 1 / (1 + std::exp((centre - k) / 2));
      curve.current_A[k] -= 0.3 * curve.current_A.front() * passed;
    }
    return Fits("cloud_edge", curve);
  };
  EXPECT_TRUE(fits(0.35, 2));
  EXPECT_TRUE(fits(0.85, 2));
  EXPECT_FALSE(fits(0.47, 2));
  EXPECT_FALSE(fits(0.99, 2));
}

// At 0 V a photodiode bends, whose current grows with the reverse voltage; at -1.5 V light dips.
TEST(ImitationTest, NoMomentOfLightAtZeroOfASweepFromDeepReverse) {
  for (const double centre_V : {-1.5, 0.0}) {
    Recipe recipe;
    recipe.from_V = -3;
    recipe.points = 120;
    IvCurve curve = SyntheticCurve(recipe);
    for (std::size_t k = 0; k < curve.size(); ++k) {
      const double from = (curve.voltage_V[k] - centre_V) / 0.12;
      curve.current_A[k] -= 0.4 * std::exp(-0.5 * from * from);
    }
    EXPECT_EQ(Fits("transient", curve), centre_V < 0);
  }
}

// A bump at open circuit of a single cell is of its contacts; elsewhere it may be of the light.
TEST(ImitationTest, NoMomentOfLightAtOpenCircuitOfACell) {
  for (const bool at_voc : {false, true}) {
    Recipe recipe;
    recipe.to_V = 0.7;
    IvCurve curve = SyntheticCurve(recipe);
    const auto negative = [](double current) { return current < 0; };
    const auto voc = std::find_if(curve.current_A.begin(), curve.current_A.end(), negative);
    const auto centre = at_voc ? voc - curve.current_A.begin() : 30;
    for (int k = 0; k < static_cast<int>(curve.size()); ++k) {
      curve.current_A[k] -= 0.4 * std::exp(-0.5 * std::pow((k - centre) / 1.2, 2));
    }
    EXPECT_EQ(Fits("transient", curve), !at_voc);
  }
}

// The last reading, Voc, was taken apart and is 0.35 V off: an effect that puts it right by cells without
// voltage would have the others give more than silicon can.
TEST(ImitationTest, NoCauseGivesCellsMoreVoltageThanTheirJunctionCan) {
  Recipe recipe;
  recipe.cells = 72;
  recipe.points = 30;
  IvCurve curve = SyntheticCurve(recipe);
  for (double& v : curve.voltage_V) v *= 0.70 / 0.63;  // as of a heterojunction
  curve.notes.bypass_diodes = 3;
  const SyntheticData made = OnTheData(curve);
  const DataTraits& traits = made.measurement.readings.traits;
  EXPECT_NEAR(traits.most_open_circuit, 0.761, 0.002);
  LawFit fit = FitBase(made.weighted, Law());
  ASSERT_TRUE(fit.usable);
  const Effect& open = *FindEffect("open_substring");
  fit.law.effects.push_back(&open);
  for (const EffectParameter& parameter : open.parameters) {
    fit.p.push_back(0.5 * (parameter.lower + parameter.upper));
  }
  EXPECT_TRUE(IsItself(made.weighted, fit));
  // Two thirds of the cells have to give all: 1.5 times the voltage of a cell.
  fit.p[SaturationCurrentIndex(0)] *= std::exp(-0.35 / (1.2 * traits.thermal_voltage));
  EXPECT_FALSE(IsItself(made.weighted, fit));
  curve.notes.technology = "CdTe";
  const SyntheticData film = OnTheData(curve);
  EXPECT_GT(film.measurement.readings.traits.most_open_circuit, 1.1);
  EXPECT_TRUE(IsItself(film.weighted, fit));
}

TEST(ImitationTest, WhatTheReadingsExceedIsNoLimit) {
  Recipe recipe;
  recipe.cells = 60;
  IvCurve curve = SyntheticCurve(recipe);
  for (double& v : curve.voltage_V) v *= 1.4;  // of another technology, or cells miscounted
  EXPECT_EQ(OnTheData(curve).measurement.readings.traits.most_open_circuit, 0);
  recipe.cells = 1;  // of an unknown technology, single cells may be anything
  EXPECT_EQ(OnTheData(SyntheticCurve(recipe)).measurement.readings.traits.most_open_circuit, 0);
}

}  // namespace
}  // namespace lyrefit
