#include "lyrefit/report/documents.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "lyrefit/report/text_layout.h"
#include "sample_diagnosis.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(DiagnosisText, TellsTheVerdictBeforeItsEvidence) {
  const std::string text = DiagnosisText(SampleDiagnosis());
  EXPECT_THAT(text, StartsWith("lyrefit 1.2.3: diagnosis of sample_module\n"));
  const std::size_t verdict = text.find("The light stepped down by 1.9 %");
  const std::size_t cause = text.find("Cause 1 of 1: step of the irradiance (irr_step)");
  const std::size_t evidence = text.find("What the readings show");
  const std::size_t trials = text.find("Effects tried");
  ASSERT_NE(trials, std::string::npos);
  EXPECT_LT(verdict, cause);
  EXPECT_LT(cause, evidence);
  EXPECT_LT(evidence, trials);
}

TEST(DiagnosisText, GivesEachCauseItsSizeAndWhatElseItCouldBe) {
  const std::string text = DiagnosisText(SampleDiagnosis());
  EXPECT_THAT(text, HasSubstr("relative step d = -0.0190, 95 %: -0.0212 .. -0.0168"));
  EXPECT_THAT(text, HasSubstr("from V1 = 12.1 V, 95 %: 11.80 .. 12.40 V, at its bound"));
  EXPECT_THAT(text, HasSubstr("corrected p = 2.0e-07"));
  EXPECT_THAT(text, HasSubstr("or else       drift of the irradiance (drift)"));
  EXPECT_THAT(text, HasSubstr("to tell       a reference cell read with every point"));
}

TEST(DiagnosisText, SaysWhatACauseMustBeToBeNamed) {
  Diagnosis diagnosis = SampleDiagnosis();
  EXPECT_THAT(DiagnosisText(diagnosis),
              HasSubstr("named         certain at 5 % over the whole catalogue\n"));
  diagnosis.floor_current = 0.0025;
  diagnosis.floor_power = 0.005;
  EXPECT_THAT(DiagnosisText(diagnosis),
              HasSubstr("certain at 5 % over the whole catalogue, and above 0.25 % of Isc"));
}

TEST(DiagnosisText, GivesEachImmaterialCauseASectionOfItsOwn) {
  Diagnosis diagnosis = SampleDiagnosis();
  diagnosis.verdict.below_floor = {SampleStepCause(), SampleStepCause()};
  const std::string text = DiagnosisText(diagnosis);
  const std::string heading = "\n\nPresent, not material: step of the irradiance (irr_step)\n";
  const std::size_t first = text.find(heading);
  ASSERT_NE(first, std::string::npos);
  EXPECT_NE(text.find(heading, first + 1), std::string::npos);
}

TEST(DiagnosisText, TellsWhatToMeasureNextWhereThatWasAskedFor) {
  Diagnosis diagnosis = SampleDiagnosis();
  EXPECT_THAT(DiagnosisText(diagnosis), Not(HasSubstr("What would tell them apart")));
  diagnosis.plan = SamplePlan();
  const std::string text = DiagnosisText(diagnosis);
  EXPECT_THAT(text, HasSubstr("What would tell them apart\n  take the sweep backwards.\n"));
  EXPECT_THAT(text, HasSubstr("between       irr_step, drift\n"));
  EXPECT_THAT(text, HasSubstr("reverse_sweep"));
  EXPECT_THAT(text, HasSubstr("97 %"));
  EXPECT_THAT(text, HasSubstr("- reverse_sweep: the sweep backwards; noise as measured."));
  diagnosis.plan->measurements.clear();
  EXPECT_THAT(DiagnosisText(diagnosis), Not(HasSubstr("between ")));
}

TEST(DiagnosisText, ShowsTheGainAndWhatMoved) {
  const std::string text = DiagnosisText(SampleDiagnosis());
  EXPECT_THAT(text, HasSubstr("RMSE in A, solved-current"));
  EXPECT_THAT(text, HasSubstr("held out in 10 parts        1.520e-02    2.400e-03"));
  EXPECT_THAT(text, HasSubstr("error falls by 84 %"));
  EXPECT_THAT(text, HasSubstr("Rsh (ohm)"));
  EXPECT_THAT(text, HasSubstr("-32.86 %"));
}

TEST(DiagnosisText, ShowsTrialsAndWhyOthersWereNot) {
  const std::string text = DiagnosisText(SampleDiagnosis());
  EXPECT_THAT(text, HasSubstr("irr_step <-     2.10e-03"));
  EXPECT_THAT(text, HasSubstr("- capacitance, instrument_lag: needs sweeps in both directions\n"));
  EXPECT_THAT(text, HasSubstr("lead_resistance (biases Rs)"));
  EXPECT_THAT(text, HasSubstr("currents lie on a grid"));
  EXPECT_THAT(text, HasSubstr("seed = 7 (default 1)"));
}

TEST(DiagnosisText, NamesNoCauseWhereThereIsNone) {
  const std::string text = DiagnosisText(SampleLitAndDark());
  EXPECT_THAT(text, HasSubstr("Something is there, but none of the known causes fits.\n"));
  EXPECT_THAT(text, HasSubstr("base RMSE     1.310e-02 A, solved-current\n  nothing to gain.\n"));
  EXPECT_THAT(text, HasSubstr("1 dark curve"));
  EXPECT_THAT(text, HasSubstr("in the dark 0.000200\n"));
  EXPECT_THAT(text, Not(HasSubstr("Cause ")));
  EXPECT_THAT(text, Not(HasSubstr("<-  ")));
  EXPECT_THAT(text, Not(HasSubstr("What a fit that ignores")));
}

// A cause found in the values has no p-value and no strength.
TEST(DiagnosisText, TakesCausesSeenInTheValues) {
  Diagnosis diagnosis = SampleDiagnosis();
  Cause& cause = diagnosis.verdict.causes[0];
  cause.evidence = "values";
  cause.corrected_p = kUnknown;
  cause.strength.clear();
  diagnosis.evidence.clipped_points = 3;
  diagnosis.evidence.clip_level_A = 5.02;
  const std::string text = DiagnosisText(diagnosis);
  EXPECT_THAT(text, HasSubstr("certainty     seen in the values themselves\n"));
  EXPECT_THAT(text, HasSubstr("clipped       3 points at 5.0200 A"));
}

TEST(DiagnosisText, SaysWhatIsUnfinishedOrWorthless) {
  Diagnosis diagnosis = SampleDiagnosis();
  diagnosis.interrupted = true;
  diagnosis.extended.usable = false;
  diagnosis.warnings = {"the noise was guessed"};
  const std::string text = DiagnosisText(diagnosis);
  EXPECT_THAT(text, StartsWith("INTERRUPTED"));
  EXPECT_THAT(text, HasSubstr("NOT USABLE"));
  EXPECT_THAT(text, HasSubstr("Warnings\n  - the noise was guessed"));
  EXPECT_THAT(BriefDiagnosis(diagnosis), HasSubstr("INTERRUPTED, NOT USABLE, 1 warning"));
}

TEST(DiagnosisText, FitsATerminalOf100Columns) {
  for (const Diagnosis& diagnosis :
       {SampleDiagnosis(), SampleUpDown(), SampleDiagnosisOfFamily(5), SampleLitAndDark()}) {
    std::istringstream lines(DiagnosisText(diagnosis));
    for (std::string line; std::getline(lines, line);) {
      EXPECT_LE(line.size(), static_cast<std::size_t>(kTextWidth)) << line;
    }
  }
}

TEST(BriefDiagnosis, IsOneLine) {
  EXPECT_EQ(BriefDiagnosis(SampleDiagnosis()),
            "sample_module: irr_step d -0.0190 (corrected p 2.0e-07) or drift; "
            "RMSE 1.310e-02 -> 2.100e-03 A solved-current\n");
  EXPECT_EQ(BriefDiagnosis(SampleLitAndDark()),
            "lit_and_dark: Something is there, but none of the known causes fits. RMSE 1.310e-02 A "
            "solved-current\n");
}

}  // namespace
}  // namespace lyrefit
