#include "lyrefit/diagnose/known_effects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/report/documents.h"
#include "synthetic_diagnosis.h"

namespace lyrefit {
namespace {

using ::testing::AnyOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

IvCurve ModuleOfThree(int points = 80) {
  Recipe recipe;
  recipe.cells = 60;
  recipe.points = points;
  IvCurve curve = SyntheticCurve(recipe);
  curve.notes.bypass_diodes = 3;
  return curve;
}

DiagnoseOptions In(Setup setup) {
  DiagnoseOptions options = Quick();
  options.setup = setup;
  return options;
}

TEST(SetupOfTest, TheOptionThenTheFileThenTheTimes) {
  IvCurve curve = ModuleOfThree();
  EXPECT_EQ(SetupOf(SetOf({curve}), {}).from, "assumed");
  curve.notes.setup = Setup::kFlash;
  curve.stated_in.setup = "line 3";
  EXPECT_EQ(SetupOf(SetOf({curve}), {}).setup, Setup::kFlash);
  EXPECT_EQ(SetupOf(SetOf({curve}), {}).source, "line 3");
  EXPECT_EQ(SetupOf(SetOf({curve}), In(Setup::kOutdoor)).setup, Setup::kOutdoor);
  EXPECT_EQ(SetupOf(SetOf({curve}), In(Setup::kOutdoor)).from, "stated");
  curve.conditions.cells_in_series = 1;  // under a simulator
  EXPECT_EQ(SetupOf(SetOf({curve}), {}).setup, Setup::kLaboratory);
  IvCurve timed = ModuleOfThree();
  for (std::size_t k = 0; k < timed.size(); ++k) {
    timed.time_s.push_back(1e-4 * static_cast<double>(k));
    timed.irradiance_W_m2.push_back(1000);
  }
  EXPECT_EQ(SetupOf(SetOf({timed}), {}).setup, Setup::kFlash);
}

// What is shade outdoors are cells that give less in a flasher.
TEST(SetupTest, NothingIsShadedInAFlasher) {
  const auto curve = ReadCurve(std::string(LYREFIT_DATA_DIR) + "/diagnosis/shaded_module.csv");
  ASSERT_TRUE(curve) << curve.error().ToString();
  EXPECT_THAT(Ids(DiagnoseOrFail(*curve)), Contains("shading"));
  const Diagnosis flash = DiagnoseOrFail(*curve, In(Setup::kFlash));
  ASSERT_THAT(Ids(flash), Contains("weak_cell"));
  const Cause& cause = flash.verdict.causes.front();
  for (const std::string& text :
       {flash.verdict.sentence, cause.title, cause.sentence, cause.action,
        cause.separate_by.front(), cause.in_words.front(), flash.verdict.not_shown}) {
    for (const char* word : {"shad", "snow", "dip", "others' light", "fades"}) {
      EXPECT_THAT(text, Not(HasSubstr(word)));
    }
  }
  EXPECT_THAT(cause.separate_by.front(), HasSubstr("lamp"));
  EXPECT_THAT(cause.equivalents, Not(Contains(AnyOf("shading", "substrings", "covered_edge"))));
  for (const Alternative& other : cause.alternatives) {
    EXPECT_THAT(other.id, Not(AnyOf("shading", "transient", "irr_step", "drift")));
  }
  for (const Trial& trial : flash.trials) {
    if (trial.effect != "transient") continue;
    EXPECT_FALSE(trial.tried);
    EXPECT_THAT(trial.why_not, HasSubstr("flash"));
  }
  EXPECT_THAT(DrawText(DiagnosisDocument(flash)), HasSubstr("flash, stated (--setup)"));
  EXPECT_EQ(flash.setup.from, "stated");
}

// Who asks for a cause by name, or says how common it is, gets it.
TEST(SetupTest, WhatIsAskedForIsTried) {
  DiagnoseOptions options = In(Setup::kFlash);
  options.effects = {"irr_step"};
  const Diagnosis asked = DiagnoseOrFail(CurveWithAStep(), options);
  EXPECT_THAT(Ids(asked), Contains("irr_step"));
  EXPECT_THAT(Ids(DiagnoseOrFail(CurveWithAStep(), In(Setup::kFlash))), Not(Contains("irr_step")));
}

// 20 readings in whole steps from 40 % of Voc on, as registers of an inverter hold them.
TEST(SetupTest, AnInverterHasFewReadingsInStepsAndNoShortCircuit) {
  Recipe recipe;
  recipe.cells = 60;
  recipe.points = 20;
  recipe.from_V = 0.26;
  IvCurve curve = SyntheticCurve(recipe);
  curve.notes.bypass_diodes = 3;
  for (double& i : curve.current_A) i = 0.1 * std::round(10 * i);
  EXPECT_THAT(Ids(DiagnoseOrFail(curve)), Contains("quantisation"));
  const Diagnosis inverter = DiagnoseOrFail(curve, In(Setup::kInverter));
  EXPECT_THAT(Ids(inverter), IsEmpty());
}

// In a flasher Voc is of a flash of its own: off by 0.35 V of 45, it makes no cause, where no substring
// without current may explain it by cells of more voltage than silicon has.
TEST(SetupTest, VocOfAnotherFlashMakesNoCause) {
  for (const double off_V : {-0.35, 0.2, 0.35}) {
    Recipe recipe;
    recipe.cells = 72;
    recipe.points = 26;
    recipe.to_V = 0.60;
    IvCurve curve = SyntheticCurve(recipe);
    curve.notes.bypass_diodes = 3;
    curve.voltage_V.push_back(72 * 0.6264 + off_V);
    curve.current_A.push_back(0);
    for (const std::string& id : Ids(DiagnoseOrFail(curve, In(Setup::kFlash)))) {
      EXPECT_EQ(id, "outliers") << off_V;
    }
  }
}

}  // namespace
}  // namespace lyrefit
