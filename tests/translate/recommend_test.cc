#include "lyrefit/translate/recommend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "synthetic_string.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

// A prepared curve at 800 W/m2 and 45 C with results of four procedures.
struct Choice {
  explicit Choice(const TranslationTarget& target) {
    made.curve = module.Curve(800, 45, target);
    made.inputs = SettleInputs(module.Coefficients(), "c-Si", made.curve, module.Bare(800, 45));
    for (const Procedure procedure :
         {Procedure::kIec1, Procedure::kIec2, Procedure::kIec4, Procedure::kDeSoto}) {
      TranslatedResult result;
      result.procedure = procedure;
      results.push_back(result);
    }
  }
  Procedure Chosen() const {
    const Recommendation best = Recommend(made, results);
    return best.result < 0 ? Procedure::kExtended : results[best.result].procedure;
  }
  void Forbid(Procedure procedure) {
    for (TranslatedResult& result : results) {
      if (result.procedure == procedure) result.why_not = "forbidden";
    }
  }
  SyntheticModule module;
  Preparation made;
  std::vector<TranslatedResult> results;
};

TEST(Recommend, MovesPointsOverASmallStepAndTheDiodeOverALargeOne) {
  EXPECT_EQ(Choice({820, 43}).Chosen(), Procedure::kIec1);
  EXPECT_EQ(Choice({1000, 25}).Chosen(), Procedure::kDeSoto);
  EXPECT_EQ(Choice({810, 25}).Chosen(), Procedure::kDeSoto);
}

TEST(Recommend, DoesWithoutBetaWhereNobodyStatedIt) {
  for (const TranslationTarget target : {TranslationTarget{820, 43}, {1000, 25}}) {
    Choice choice(target);
    choice.made.inputs.beta_scatter = 0.05;
    EXPECT_EQ(choice.Chosen(), Procedure::kIec4) << target.irradiance_W_m2;
    choice.made.inputs.crystalline_silicon = false;
    EXPECT_EQ(choice.Chosen(), Procedure::kDeSoto) << target.irradiance_W_m2;
  }
}

TEST(Recommend, TakesWhatThereIs) {
  Choice choice({1000, 25});
  choice.Forbid(Procedure::kDeSoto);
  EXPECT_EQ(choice.Chosen(), Procedure::kIec4);
  choice.Forbid(Procedure::kIec4);
  EXPECT_EQ(choice.Chosen(), Procedure::kIec2);
  for (TranslatedResult& result : choice.results) result.why_not = "forbidden";
  const Recommendation none = Recommend(choice.made, choice.results);
  EXPECT_EQ(none.result, -1);
  EXPECT_THAT(none.reason, HasSubstr("no procedure"));
}

// A shunt resistance of 5 Voc / Isc, in readings with and without open circuit.
TEST(Recommend, HasALowShuntCarriedByTheExtendedModel) {
  for (const bool to_open_circuit : {true, false}) {
    Choice choice({1000, 25});
    const KeyPoints key = choice.module.Truth(800, 45);
    choice.made.curve.diode->resistance_shunt_ohm =
        5 * key.open_circuit_voltage_V / key.short_circuit_current_A;
    CurvePoints& points = choice.made.curve.points;
    while (!to_open_circuit && points.current_A.back() < 0.05 * key.short_circuit_current_A) {
      points.voltage_V.pop_back();
      points.current_A.pop_back();
    }
    TranslatedResult extended;
    extended.procedure = Procedure::kExtended;
    choice.results.push_back(extended);
    const Recommendation best = Recommend(choice.made, choice.results);
    ASSERT_EQ(best.result, 4) << to_open_circuit;
    EXPECT_THAT(best.reason, HasSubstr("the shunt is low"));
  }
}

}  // namespace
}  // namespace lyrefit
