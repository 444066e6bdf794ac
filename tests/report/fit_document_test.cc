#include "lyrefit/report/documents.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "lyrefit/report/text_layout.h"
#include "sample_report.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// The first line that holds `text`.
std::string LineWith(const std::string& report, const std::string& text) {
  std::istringstream lines(report);
  for (std::string line; std::getline(lines, line);) {
    if (line.find(text) != std::string::npos) return line;
  }
  return "";
}

// The text with every run of white space replaced by one space.
std::string OneLine(const std::string& report) {
  std::istringstream words(report);
  std::string line;
  for (std::string word; words >> word;) line += (line.empty() ? "" : " ") + word;
  return line;
}

TEST(FullReport, FitsATerminalOf100Columns) {
  FitReport report = SampleReport();
  report.warnings = {
      "a warning of many words that goes on and on, longer than any terminal is wide, "
      "because the matter is not simple and wants to be explained in plain words"};
  report.variants = {
      {"shading.d, shading.w, shading.Vb, shading.c, irr_step.s, irr_step.x0 free; "
       "irr_step.shape = 2",
       6, 1e-3, 0, true, true},
      {"shading.d, shading.w, shading.Vb, irr_step.s free", 4, 1e-3, 1e5, false, false}};
  for (Estimate& e : report.estimates) {
    e.at_bound = BoundSide::kLower;
    e.identifiable = false;
    e.reason = report.warnings[0];
  }
  std::istringstream lines(FullReport(report));
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), static_cast<std::size_t>(kTextWidth)) << line;
  }
}

TEST(FullReport, ShowsSearchedAndRefinedSideBySide) {
  const std::string text = FullReport(SampleReport());
  const std::string line = LineWith(text, "  Rs (ohm)");
  EXPECT_THAT(line, HasSubstr("0.036300    0.0365469  0.00045  0.03563 .. 0.03746"));
}

TEST(FullReport, LabelsBothRmsesAndMarksTheFittedOne) {
  FitReport report = SampleReport();
  EXPECT_THAT(FullReport(report), HasSubstr("measured-current  solved-current *"));
  EXPECT_THAT(LineWith(FullReport(report), "refined (best"),
              HasSubstr("9.891234568e-04   7.730062690e-04"));
  report.objective = Objective::kMeasuredCurrent;
  EXPECT_THAT(FullReport(report), HasSubstr("measured-current *   solved-current"));
}

TEST(FullReport, SaysHowMuchRoomIsLeftBelowWhereThatWasAskedFor) {
  FitReport report = SampleReport();
  EXPECT_THAT(FullReport(report), Not(HasSubstr("Floor:")));
  report.floor =
      FloorReport{Objective::kMeasuredCurrent, 9.824848761e-4, 9.824848761e-4, 0, 1, 2, 0.0036};
  const std::string text = FullReport(report);
  EXPECT_THAT(OneLine(text), HasSubstr("Floor: no number of diodes with n in [1, 2] brings the "
                                       "measured-current RMSE below 9.824848761e-04 A, and the "
                                       "refined answer is 0.360 % above it."));
  report.floor->objective = Objective::kSolvedCurrent;
  report.floor->above = 1e-12;
  EXPECT_THAT(OneLine(FullReport(report)),
              HasSubstr("the solved-current RMSE below 9.824848761e-04 A, and the refined answer "
                        "attains it."));
  report.floor->gap = 7e-7;
  EXPECT_THAT(OneLine(FullReport(report)), HasSubstr("attains it to within 7e-07 of itself."));
  report.floor->above = 0.02;
  report.floor->minimised = false;
  EXPECT_THAT(OneLine(FullReport(report)),
              HasSubstr("is 2.00 % above it, but it was not fitted for the least RMSE."));
}

TEST(FullReport, SaysWhereTheFloorIsNotSettled) {
  FitReport report = SampleReport();
  report.floor = FloorReport{Objective::kSolvedCurrent, 1e-3, 9e-4, 0.1, 1, 2, 0.05};
  EXPECT_THAT(
      OneLine(FullReport(report)),
      HasSubstr("Floor, not settled: diodes with n in [1, 2] reach a solved-current RMSE of "
                "1.000000000e-03 A, and the refined answer is 5.00 % above it; only that "
                "nothing lies below 9.000000000e-04 A is proved."));
  report.floor->above = 0;
  report.floor->lower_bound_A = 0;
  report.floor->gap = 1;
  EXPECT_THAT(OneLine(FullReport(report)),
              HasSubstr("and the refined answer is as low; no lower bound is proved."));
}

TEST(FullReport, SaysWhereThereWasNoPolish) {
  FitReport report = SampleReport();
  report.polished = false;
  const std::string text = FullReport(report);
  EXPECT_THAT(text, HasSubstr("No polish was done"));
  EXPECT_THAT(LineWith(text, "  polish "), HasSubstr("none"));
  EXPECT_THAT(LineWith(text, "refined (best"), Not(HasSubstr("e-04")));
  EXPECT_THAT(LineWith(text, "best candidate polished"), Not(HasSubstr("e-04")));
}

TEST(FullReport, StartsWithInterrupted) {
  FitReport report = SampleReport();
  EXPECT_THAT(FullReport(report), StartsWith("lyrefit 1.2.3"));
  report.interrupted = true;
  EXPECT_THAT(FullReport(report), StartsWith("INTERRUPTED"));
}

TEST(FullReport, SaysNotUsable) {
  FitReport report = SampleReport();
  report.usable = false;
  EXPECT_THAT(FullReport(report), StartsWith("NOT USABLE"));
}

TEST(FullReport, SaysFirstWhyItIsNotUsableAndWhatIsDoubtful) {
  FitReport report = SampleReport();
  report.doubts = {"Voc is 38 V: some 60 cells in series?"};
  EXPECT_THAT(FullReport(report), StartsWith("DOUBTFUL: Voc is 38 V: some 60 cells in series?\n"));
  report.usable = false;
  report.not_usable_because = "the curve has a step near 25 V";
  EXPECT_THAT(FullReport(report),
              StartsWith("NOT USABLE: the curve has a step near 25 V.\n\nDOUBTFUL: "));
  EXPECT_THAT(BriefReport(report), HasSubstr(", NOT USABLE: the curve has a step near 25 V"));
}

TEST(FullReport, SaysWhyThereAreNoIntervals) {
  FitReport report = SampleReport();
  EXPECT_THAT(FullReport(report), Not(HasSubstr("intervals: none")));
  report.no_intervals_because = "the fit is not usable";
  EXPECT_THAT(FullReport(report),
              HasSubstr("95 % intervals: none, since the fit is not usable.\n"));
}

TEST(FullReport, MarksBoundsFixedAndNotIdentifiable) {
  FitReport report = SampleReport();
  report.estimates[0].fixed = true;
  report.estimates[2].at_bound = BoundSide::kUpper;
  report.estimates[4].identifiable = false;
  report.estimates[4].reason = "any shunt above 800 ohm fits as well";
  const std::string text = FullReport(report);
  EXPECT_THAT(LineWith(text, "  Iph "), HasSubstr("fixed"));
  EXPECT_THAT(LineWith(text, "  n1 "), HasSubstr("upper bound"));
  EXPECT_THAT(LineWith(text, "  Rsh "), HasSubstr("not identifiable"));
  EXPECT_THAT(text, HasSubstr("Rsh is not identifiable: any shunt above 800 ohm fits as well"));
}

TEST(FullReport, SpellsUnknownNumbersAsADash) {
  FitReport report = SampleReport();
  report.simulated.open_circuit_voltage_V = kUnknown;
  EXPECT_EQ(LineWith(FullReport(report), "  Voc"),
            "  Voc          0.572700          -           -  V");
}

TEST(FullReport, JudgesResidualsInWords) {
  FitReport report = SampleReport();
  EXPECT_THAT(FullReport(report), HasSubstr("consistent with independent noise"));
  report.residuals.runs = 5;
  report.residuals.runs_p_value = 0.001;
  EXPECT_THAT(FullReport(report), HasSubstr("go together"));
  report.residuals.runs = 24;
  EXPECT_THAT(FullReport(report), HasSubstr("alternate"));
  report.residuals.runs_p_value = kUnknown;
  report.residuals.durbin_watson = kUnknown;
  EXPECT_THAT(FullReport(report), HasSubstr("too few points to say"));
}

TEST(FullReport, ShowsHowItWasFound) {
  const std::string text = FullReport(SampleReport());
  EXPECT_THAT(LineWith(text, "  search "),
              HasSubstr("mlo, seed 7, 30 candidates x 40 iterations, 1200 evaluations"));
  EXPECT_THAT(text,
              HasSubstr("2 of 3 came to the same curve; the best end came from start 2: elite 2"));
  EXPECT_THAT(text, HasSubstr("seed = 7 (default 0)"));
  FitReport knees = SampleReport();
  knees.curve_evaluations = 5432;
  EXPECT_THAT(FullReport(knees), HasSubstr("1200 evaluations (5432 of the"));
  EXPECT_THAT(text, HasSubstr("irradiance not given: assumed 1000 W/m2"));
}

TEST(FullReport, ShowsTheChoiceOfTheModel) {
  FitReport report = SampleReport();
  EXPECT_THAT(FullReport(report), Not(HasSubstr("Choice of the model")));
  report.choice = ModelChoice{Model::kSingleDiode,
                              {{Model::kSingleDiode, 7.73e-4, 8.5e-4, -358.5, kUnknown, true},
                               {Model::kDoubleDiode, 7.33e-4, 8.6e-4, -355.5, 0.24, false}},
                              "A second diode does not pay."};
  const std::string text = FullReport(report);
  EXPECT_THAT(LineWith(text, "sd <-"), HasSubstr("7.73000e-04"));
  EXPECT_THAT(LineWith(text, "  dd "), HasSubstr("0.24  no"));
  EXPECT_THAT(text, HasSubstr("A second diode does not pay."));
}

TEST(FullReport, CountsTheOptimaOfAModelWithEffects) {
  FitReport report = SampleReport();
  report.refine.starts.resize(49, {"random", 9e-4, 7.8e-4, false});
  report.refine.local_optima = OptimumCount{14, 3, 6, {14, 3, 6, 2, 0}, 1};
  const std::string text = FullReport(report);
  EXPECT_THAT(
      text,
      HasSubstr("14 of 49 went to their end, in 3 local optima, the best of them reached 6 "));
  EXPECT_THAT(text, HasSubstr("35 were given up"));
  EXPECT_THAT(text, HasSubstr("the best end came from start 2: elite 2"));
  EXPECT_THAT(text, Not(HasSubstr("came to the same curve")));
  EXPECT_THAT(LineWith(text, "  local optima "),
              HasSubstr("by Chao's estimate (doi:10.2307/2531532) 1.0 more were probably not"));
  EXPECT_THAT(text, HasSubstr("local optima were reached just once\n"));
  EXPECT_THAT(text, Not(HasSubstr("beside an earlier end")));
  report.refine.local_optima = OptimumCount{14, 3, 6, {9, 2, 4, 1, 0}, 0};
  EXPECT_THAT(LineWith(FullReport(report), "  local optima "),
              HasSubstr("9 of the 14 ends did not begin beside an earlier end, 4 of those in the"));
  EXPECT_THAT(FullReport(report), HasSubstr("none was left unseen: only one"));
  report.refine.local_optima = OptimumCount{5, 1, 5, {2, 1, 0, 0, 1}, kUnknown};
  EXPECT_THAT(LineWith(FullReport(report), "  local optima "), HasSubstr("none of those in the"));
  EXPECT_THAT(FullReport(report),
              HasSubstr("few descents to estimate how many local optima were not seen"));
  report.refine.local_optima = OptimumCount{5, 1, 0, {5, 1, 0, 0, 0}, 0};  // interrupted
  EXPECT_THAT(FullReport(report), HasSubstr("in 1 local optimum, none of them the best"));
  EXPECT_EQ(text.find("random "), text.rfind("random "));  // random baseline: no line per start
  report.refine.starts.resize(14);
  report.refine.local_optima = OptimumCount{14, 1, 14, {14, 1, 14, 0, 0}, 0};
  EXPECT_THAT(
      LineWith(FullReport(report), "  starts "),
      HasSubstr(
          "14 of 14 went to their end, in 1 local optimum, the best of them reached 14 times"));
  EXPECT_THAT(FullReport(report), Not(HasSubstr("given up")));
  EXPECT_THAT(LineWith(FullReport(report), "  local optima "),
              HasSubstr("none was left unseen: none was reached"));
  report.refine.local_optima = OptimumCount{1, 1, 1, {1, 1, 1, 1, 0}, kUnknown};
  EXPECT_THAT(
      FullReport(report),
      HasSubstr("1 of 14 went to its end, in 1 local optimum, the best of them reached once"));
  EXPECT_THAT(LineWith(FullReport(report), "  local optima "),
              HasSubstr("too few descents to estimate how many local optima were not seen"));
  report.refine.local_optima = OptimumCount{};  // interrupted
  EXPECT_THAT(FullReport(report), HasSubstr("none of 14 went to its end"));
  EXPECT_EQ(LineWith(FullReport(report), "  local optima "), "");
}

TEST(FullReport, ShowsTheVariantsThatEffectsCanHave) {
  FitReport report = SampleReport();
  EXPECT_THAT(FullReport(report), Not(HasSubstr("Choice of the variant")));
  report.variants = {{"d, Vb, m, A free", 4, 7.73e-4, 0, true, true},
                     {"d, Vb free; a = 0", 2, 1.2e-3, 87.654, false, false}};
  const std::string text = FullReport(report);
  EXPECT_THAT(LineWith(text, "d, Vb, m, A free <-"), HasSubstr("7.73000e-04"));
  EXPECT_THAT(LineWith(text, "d, Vb, m, A free <-"), Not(HasSubstr("given up")));
  EXPECT_THAT(LineWith(text, "d, Vb free; a = 0"), HasSubstr("1.20000e-03"));
  EXPECT_THAT(LineWith(text, "d, Vb free; a = 0"),
              HasSubstr("87.65  d, Vb free; a = 0 (given up: at most this much)"));
  EXPECT_THAT(text, HasSubstr("RMSE in A (solved-current)"));
}

TEST(FullReport, TellsWholeNumbersFromFixedOnes) {
  FitReport report = SampleReport();
  report.estimates[2].bounds.whole = 1;
  report.estimates[2].standard_error = kUnknown;
  const std::string line = LineWith(FullReport(report), "  n1 ");
  EXPECT_THAT(line, HasSubstr("whole number, settled by trying"));
  EXPECT_THAT(line, Not(HasSubstr("fixed")));
}

TEST(FullReport, TakesAnEmptyReport) {
  FitReport report;
  report.measured = report.simulated = {kUnknown, kUnknown, kUnknown, kUnknown, kUnknown, kUnknown};
  EXPECT_FALSE(FullReport(report).empty());
  EXPECT_FALSE(BriefReport(report).empty());
}

TEST(FitDocument, TellsTheAnswerBeforeItsEvidence) {
  FitReport report = SampleReport();
  report.warnings = {"a warning"};
  const Document document = FitDocument(report);
  EXPECT_EQ(document.head.heading, "lyrefit 1.2.3: single-diode model of sample_cell");
  std::vector<std::string> headings;
  for (const Section& section : document.sections) headings.push_back(section.heading);
  EXPECT_THAT(headings, ElementsAre("Parameters", "RMSE in A   (* the objective that was fitted)",
                                    "Key points", "Residuals (model - measured, solved-current)",
                                    "How it was found", "Assumptions", "Warnings"));
  EXPECT_EQ(DrawText(document), FullReport(report));
}

TEST(BriefReport, IsOneLineWithBothLabels) {
  const std::string text = BriefReport(SampleReport());
  EXPECT_EQ(text.find('\n'), text.size() - 1);
  EXPECT_THAT(text, StartsWith("sample_cell: sd, RMSE 9.891234568e-04 A measured-current, "
                               "7.730062690e-04 A solved-current (fitted: solved-current)"));
  EXPECT_THAT(text, HasSubstr("Rs 0.0365469 ohm"));
}

}  // namespace
}  // namespace lyrefit
