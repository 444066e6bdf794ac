#include "lyrefit/report/documents.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "lyrefit/report/text_layout.h"
#include "sample_family.h"

namespace lyrefit {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

void ExpectNarrow(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), static_cast<std::size_t>(kTextWidth)) << line;
  }
}

TEST(FamilyText, TellsTheHead) {
  const std::string text = FamilyText(MakeSampleFamily(8).report);
  EXPECT_THAT(text, StartsWith("lyrefit 1.2.3: one single-diode device by the law of De Soto"));
  EXPECT_THAT(text, HasSubstr("sample_module, 8 curves (data/sample_module)"));
  EXPECT_THAT(text, HasSubstr("6 fitted, 1 held out, 1 left out, 1 rejected"));
  EXPECT_THAT(text,
              HasSubstr("irradiance 100 to 1000 W/m2, cell temperature 15 to 55 C; 36 cells"));
  EXPECT_THAT(text, HasSubstr("solved-current; constants codata; seed 0"));
}

TEST(FamilyText, TellsSharedParametersSearchedAndRefined) {
  const std::string text = FamilyText(MakeSampleFamily(8).report);
  EXPECT_THAT(text, HasSubstr("Rs (ohm)     R_s           0.3131      0.310000"));
  EXPECT_THAT(text, HasSubstr("upper bound"));
  EXPECT_THAT(text, HasSubstr("fixed"));
  EXPECT_THAT(text, HasSubstr("Eg is not identifiable: the temperatures span 2 K only"));
  EXPECT_THAT(text, HasSubstr("each left out in turn"));
  EXPECT_THAT(text, HasSubstr("irradiance    -3.100 W/m2, 95 % -3.90 .. -2.30"));
  EXPECT_THAT(text, HasSubstr("gamma_pmp     -0.4500 %/K, 95 % -0.4700 .. -0.4300"));
  EXPECT_THAT(text, HasSubstr("Pmp 82.2500 W"));
}

TEST(FamilyText, LabelsEveryRmseAndSaysOverWhichCurves) {
  const std::string text = FamilyText(MakeSampleFamily(8).report);
  EXPECT_THAT(text, HasSubstr("measured-current  solved-current *  over"));
  EXPECT_THAT(text, HasSubstr("9.800000e-03      7.700000e-03  the 2 curves of the search"));
  EXPECT_THAT(text, HasSubstr("1.534000e-03      1.432100e-03  all 6 curves fitted"));
}

TEST(FamilyText, TellsEachCurveAndWhatWasNotFitted) {
  const std::string text = FamilyText(MakeSampleFamily(8).report);
  EXPECT_THAT(text, HasSubstr("held out"));
  EXPECT_THAT(text, HasSubstr("228.57?"));
  EXPECT_THAT(text, HasSubstr("1.20e-03    +1.23   -0.045  outlier"));
  EXPECT_THAT(text, HasSubstr("sweep-1: taken in the dark"));
  EXPECT_THAT(text, HasSubstr("torn: torn.csv:7:3: expected a number"));
  EXPECT_THAT(text, HasSubstr("1.100 .. 1.500 .. 1.900"));
  EXPECT_THAT(text, HasSubstr("desoto  sd <-"));
}

// 1.8 mA is 0.036 % of 5.0026 A.
TEST(FamilyText, TellsTheTestOnCurvesNotSeenBesideParametersFromElsewhereAndTheFloor) {
  FamilyReport report = MakeSampleFamily(8).report;
  std::string text = FamilyText(report);
  EXPECT_THAT(text, HasSubstr("Curves that the fit did not see\n  tested on     5 folds"));
  EXPECT_THAT(text, ContainsRegex("joint fit +De Soto +1.800e-03 +0.036 +1.900e-03 +2.500e-03  "
                                  "sweep-0"));
  EXPECT_THAT(text, ContainsRegex("sheet.json +De Soto +4.800e-03 +0.096 +4.900e-03 +6.500e-03  "
                                  "sweep-3"));
  EXPECT_THAT(text, ContainsRegex("each curve on its own +1.200e-03 +0.024"));
  EXPECT_THAT(text, ContainsRegex("Only[ \n]+the[ \n]+joint[ \n]+fit"));
  report.in_sample = report.held_out;
  report.held_out.reset();
  text = FamilyText(report);
  EXPECT_THAT(text, HasSubstr("Parameters from elsewhere on the curves fitted"));
  EXPECT_THAT(text, Not(HasSubstr("Curves that the fit did not see")));
  report.against[0].name = "a very long name of a file that nobody would type.json";
  report.in_sample->largest_id = "a very long name of a curve";
  ExpectNarrow(FamilyText(report));
}

TEST(FamilyText, TellsHowToFitWithoutOutlierCurves) {
  const std::string text = FamilyText(MakeSampleFamily(8).report);
  EXPECT_THAT(text, HasSubstr("curve sweep-2 looks like another device"));
  EXPECT_THAT(text, HasSubstr("Without it: RMSE 1.100e-03 A measured-current, 1.000e-03 A"));
  EXPECT_THAT(text, HasSubstr("To fit without: --leave-out sweep-2"));
}

TEST(FamilyText, ShowsTheWorstOfManyCurves) {
  const std::string text = FamilyText(MakeSampleFamily(200).report);
  EXPECT_THAT(text, HasSubstr("\n  sweep-199 "));
  EXPECT_THAT(text, HasSubstr("\n  sweep-190 "));
  EXPECT_THAT(text, Not(HasSubstr("\n  sweep-189 ")));
  EXPECT_THAT(text, HasSubstr("the worst 10 of 200 curves by solved-current RMSE"));
}

TEST(FamilyText, FitsATerminalOf100Columns) {
  ExpectNarrow(FamilyText(MakeSampleFamily(8).report));
  SampleFamily sample = MakeFreeSample(8);
  sample.report.curves[3].id = "a very long name of a curve that nobody would type";
  ExpectNarrow(FamilyText(sample.report));
  sample.report.translation.spec.model = Model::kDoubleDiode;
  for (FamilyCurve& curve : sample.report.curves) {
    curve.individual_parameters.insert(curve.individual_parameters.end(), {1.2e-7, 2});
  }
  ExpectNarrow(FamilyText(sample.report));
}

TEST(FamilyText, TellsTheParametersOfCurvesFittedOneByOne) {
  const std::string text = FamilyText(MakeFreeSample(8).report);
  EXPECT_THAT(text, HasSubstr("single-diode model of every curve of sample_module on its own"));
  EXPECT_THAT(text, HasSubstr("Curves, each fitted on its own (RMSE: solved-current)"));
  EXPECT_THAT(text, HasSubstr("0.3162"));
  EXPECT_THAT(text, Not(HasSubstr("Shared parameters")));
  EXPECT_THAT(text, Not(HasSubstr("free fit")));
}

TEST(FamilyText, SaysInterruptedAndNotUsable) {
  FamilyReport report = MakeSampleFamily(8).report;
  report.interrupted = true;
  report.usable = false;
  EXPECT_THAT(FamilyText(report), StartsWith("INTERRUPTED"));
  EXPECT_THAT(FamilyText(report), HasSubstr("NOT USABLE"));
}

TEST(BriefFamily, IsOneLine) {
  const std::string text = BriefFamily(MakeSampleFamily(8).report);
  EXPECT_THAT(text, StartsWith("sample_module: desoto sd, 6 fitted, 1 held out"));
  EXPECT_THAT(text, HasSubstr("RMSE 1.53400e-03 A measured-current, 1.43210e-03 A solved-current"));
  EXPECT_THAT(text, HasSubstr("Rs 0.310000 ohm"));
  EXPECT_EQ(text.find('\n'), text.size() - 1);
}

}  // namespace
}  // namespace lyrefit
