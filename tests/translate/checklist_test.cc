#include "lyrefit/translate/checklist.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// 60 cells; the default range is from 0 V to beyond Voc.
IvCurve Curve(int points = 101, double from_V = 0, double to_V = 38) {
  IvCurve curve;
  curve.conditions.cells_in_series = 60;
  curve.conditions.irradiance_W_m2 = 850;
  curve.conditions.cell_temperature_K = 318.15;
  for (int i = 0; i < points; ++i) {
    const double v = from_V + (to_V - from_V) * i / (points - 1);
    curve.voltage_V.push_back(v);
    curve.current_A.push_back(8 - 1e-9 * std::expm1(v / 1.63));
  }
  return curve;
}

const CheckedCondition& Of(const Checklist& list, const std::string& id) {
  for (const CheckedCondition& each : list.conditions) {
    if (each.id == id) return each;
  }
  ADD_FAILURE() << id;
  return list.conditions[0];
}

Checklist Checked(const IvCurve& curve, const ConditionFacts& facts = {},
                  const ChecklistOptions& options = {}) {
  return CheckConditions(curve, facts, options);
}

TEST(Checklist, TakesNothingAsMetThatNobodySaid) {
  IvCurve curve = Curve();
  curve.irradiance_known = curve.temperature_known = curve.cells_known = false;
  const Checklist list = Checked(curve);
  for (const char* id : {"irradiance", "steadiness", "sweep_time", "light_sensor", "temperature",
                         "instrument", "wind", "cells"}) {
    EXPECT_EQ(Of(list, id).state, Condition::kNotKnown) << id;
    EXPECT_THAT(Of(list, id).cure, Not(IsEmpty())) << id;
  }
  EXPECT_EQ(list.not_known, 8);
  EXPECT_EQ(list.met, 3) << "what the readings show: both axes, their number";
  EXPECT_THAT(list.sentence, HasSubstr("3 of 11 conditions met; not known: light above 700"));
}

TEST(Checklist, AllCanBeMet) {
  IvCurve curve = Curve();
  for (std::size_t i = 0; i < curve.size(); ++i) {
    curve.time_s.push_back(0.02 * static_cast<double>(i));
    curve.irradiance_W_m2.push_back(i % 2 == 0 ? 849 : 851);
  }
  ConditionFacts facts;
  facts.uncertainty.light_source = LightSource::kReferenceCell;
  facts.uncertainty.temperature_source = TemperatureSource::kBackOfModule;
  facts.uncertainty.voltage_percent = facts.uncertainty.current_percent = 0.5;
  facts.procedure = Procedure::kIec1;
  ChecklistOptions options;
  options.wind_m_s = 2;
  const Checklist list = Checked(curve, facts, options);
  EXPECT_EQ(list.met, 12) << list.sentence;
  EXPECT_THAT(Of(list, "temperature").found, HasSubstr("cells +2.1 K"));
  for (const CheckedCondition& each : list.conditions) {
    EXPECT_THAT(each.cure, IsEmpty()) << each.id;
    EXPECT_THAT(each.found, Not(IsEmpty())) << each.id;
    EXPECT_THAT(each.source, Not(IsEmpty())) << each.id;
  }
}

TEST(Checklist, SaysWhatIsNotMetWithItsFigure) {
  IvCurve curve = Curve(20, 3, 35);
  curve.conditions.irradiance_W_m2 = 610;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    curve.time_s.push_back(0.5 * static_cast<double>(i));
    curve.irradiance_W_m2.push_back(600 + 2 * static_cast<double>(i));
  }
  ConditionFacts facts;
  facts.uncertainty.light_source = LightSource::kPyranometer;
  facts.uncertainty.irradiance_percent = 6;
  facts.uncertainty.temperature_K = 3;
  facts.uncertainty.voltage_percent = 0.5;
  facts.uncertainty.current_percent = 1.5;
  facts.procedure = Procedure::kIec1;
  ChecklistOptions options;
  options.wind_m_s = 5;
  const Checklist list = Checked(curve, facts, options);
  EXPECT_EQ(list.not_met, 11) << list.sentence;
  EXPECT_EQ(list.met, 1) << "the cells";
  EXPECT_DOUBLE_EQ(Of(list, "irradiance").value, 610);
  EXPECT_DOUBLE_EQ(Of(list, "sweep_time").value, 9.5);
  EXPECT_NEAR(Of(list, "steadiness").value, 100 * 19.0 / 619, 1e-9);
  EXPECT_DOUBLE_EQ(Of(list, "light_sensor").limit, 5) << "of a pyranometer";
  EXPECT_NEAR(Of(list, "light_step").value, 39, 1e-9);
}

TEST(Checklist, LightFromTheCurveCannotSeeSoiling) {
  ConditionFacts facts;
  facts.uncertainty.light_source = LightSource::kCurve;
  const CheckedCondition item = Of(Checked(Curve(), facts), "light_sensor");
  EXPECT_EQ(item.state, Condition::kNotMet);
  EXPECT_THAT(item.cure, HasSubstr("uniform soiling"));
}

TEST(Checklist, DiagnosisTellsWhetherTheLightWasSteady) {
  Diagnosis diagnosis;
  ConditionFacts facts;
  facts.diagnosis = &diagnosis;
  EXPECT_EQ(Of(Checked(Curve(), facts), "steadiness").state, Condition::kNotKnown)
      << "it did not look for it";
  Trial trial;
  trial.effect = "irr_step";
  trial.tried = true;
  diagnosis.trials.push_back(trial);
  EXPECT_EQ(Of(Checked(Curve(), facts), "steadiness").state, Condition::kMet);
  Cause cause;
  cause.id = "irr_step";
  cause.sentence = "the light fell by 5 % at 20 V";
  diagnosis.verdict.causes.push_back(cause);
  const CheckedCondition item = Of(Checked(Curve(), facts), "steadiness");
  EXPECT_EQ(item.state, Condition::kNotMet);
  EXPECT_EQ(item.found, "the light fell by 5 % at 20 V");
}

}  // namespace
}  // namespace lyrefit
