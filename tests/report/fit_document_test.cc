#include "lyrefit/report/documents.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "golden.h"
#include "sample_fits.h"
#include "sample_report.h"

namespace lyrefit {
namespace {

// Adds how the text of the sample report changes with `change`.
template <class Change>
void AddCase(const std::string& title, const Change& change, Golden* golden) {
  FitReport report = SampleReport();
  change(&report);
  golden->AddChanges(title, FullReport(report));
}

TEST(FullReport, SaysWhatTheGoldenFileHas) {
  Golden golden("fit");
  golden.Add("one diode", FullReport(SampleReport()));
  AddCase(
      "fitted to the measured current",
      [](FitReport* report) { report->objective = Objective::kMeasuredCurrent; }, &golden);
  AddCase(
      "no polish",
      [](FitReport* report) {
        report->polished = false;
        report->refine = {};
        report->interval_seconds = 0;
      },
      &golden);
  AddCase(
      "interrupted", [](FitReport* report) { report->interrupted = true; }, &golden);
  AddCase(
      "not usable", [](FitReport* report) { report->usable = false; }, &golden);
  AddCase(
      "doubtful, and not usable for a reason",
      [](FitReport* report) {
        report->doubts = {"Voc is 38 V: some 60 cells in series?"};
        report->usable = false;
        report->not_usable_because = "the curve has a step near 25 V";
      },
      &golden);
  AddCase(
      "no intervals",
      [](FitReport* report) { report->no_intervals_because = "the fit is not usable"; }, &golden);
  AddCase(
      "fixed, at a bound, not identifiable",
      [](FitReport* report) {
        report->estimates[0].fixed = true;
        report->estimates[2].at_bound = BoundSide::kUpper;
        report->estimates[4].identifiable = false;
        report->estimates[4].reason = "any shunt above 800 ohm fits as well";
      },
      &golden);
  AddCase(
      "a whole number",
      [](FitReport* report) {
        report->estimates[2].bounds.whole = 1;
        report->estimates[2].standard_error = kUnknown;
      },
      &golden);
  AddCase(
      "no open circuit",
      [](FitReport* report) { report->simulated.open_circuit_voltage_V = kUnknown; }, &golden);
  AddCase(
      "evaluations beside the candidates",
      [](FitReport* report) { report->curve_evaluations = 5432; }, &golden);
  AddCase(
      "a choice among models",
      [](FitReport* report) {
        report->choice =
            ModelChoice{Model::kSingleDiode,
                        {{Model::kSingleDiode, 7.73e-4, 8.5e-4, -358.5, kUnknown, true},
                         {Model::kDoubleDiode, 7.33e-4, 8.6e-4, -355.5, 0.24, false}},
                        "A second diode does not pay."};
      },
      &golden);
  AddCase(
      "variants of the effects",
      [](FitReport* report) {
        report->variants = {{"d, Vb, m, A free", 4, 7.73e-4, 0, true, true},
                            {"d, Vb free; a = 0", 2, 1.2e-3, 87.654, false, false}};
      },
      &golden);
  AddCase(
      "long texts",
      [](FitReport* report) {
        report->warnings = {
            "a warning of many words that goes on and on, longer than any terminal is wide, "
            "because the matter is not simple and wants to be explained in plain words"};
        report->variants = {
            {"shading.d, shading.w, shading.Vb, shading.c, irr_step.s, irr_step.x0 free; "
             "irr_step.shape = 2",
             6, 1e-3, 0, true, true},
            {"shading.d, shading.w, shading.Vb, irr_step.s free", 4, 1e-3, 1e5, false, false}};
        for (Estimate& e : report->estimates) {
          e.at_bound = BoundSide::kLower;
          e.identifiable = false;
          e.reason = report->warnings[0];
        }
      },
      &golden);
  golden.Check();
}

TEST(FullReport, TellsTheFloorAsTheGoldenFileHasIt) {
  Golden golden("fit_floor");
  const FloorReport settled{
      Objective::kMeasuredCurrent, 9.824848761e-4, 9.824848761e-4, 0, 1, 2, 0.0036};
  const FloorReport open{Objective::kSolvedCurrent, 1e-3, 9e-4, 0.1, 1, 2, 0.05};
  const auto add = [&](const std::string& title, const FloorReport& floor) {
    FitReport report = SampleReport();
    report.floor = floor;
    golden.AddChanges(title, FullReport(report));
  };
  golden.Add("none asked for", FullReport(SampleReport()));
  add("of the other objective", settled);
  FloorReport floor = settled;
  floor.objective = Objective::kSolvedCurrent;
  floor.above = 1e-12;
  add("attained", floor);
  floor.gap = 7e-7;
  add("attained to within a gap", floor);
  floor.above = 0.02;
  floor.minimised = false;
  add("of a fit that does not minimise it", floor);
  add("not settled", open);
  FitReport searched_in_part = SampleReport();
  searched_in_part.floor = settled;
  searched_in_part.steepest_n = 1;
  golden.AddChanges("of the part of the bounds that is searched", FullReport(searched_in_part));
  floor = open;
  floor.above = 0;
  floor.lower_bound_A = 0;
  floor.gap = 1;
  add("nothing proved", floor);
  golden.Check();
}

TEST(FullReport, JudgesResidualsAsTheGoldenFileHasIt) {
  Golden golden("fit_residuals");
  const auto add = [&](const std::string& title, int runs, double p_value, double durbin_watson) {
    FitReport report = SampleReport();
    report.residuals.runs = runs;
    report.residuals.runs_p_value = p_value;
    report.residuals.durbin_watson = durbin_watson;
    golden.AddChanges(title, FullReport(report));
  };
  golden.Add("independent", FullReport(SampleReport()));
  add("few runs", 5, 0.001, 1.61);
  add("many runs", 24, 0.001, 1.61);
  add("too few points", 24, kUnknown, kUnknown);
  golden.Check();
}

TEST(FullReport, CountsTheOptimaOfAModelWithEffectsAsTheGoldenFileHasIt) {
  Golden golden("fit_optima");
  const auto add = [&](const std::string& title, std::size_t starts, const OptimumCount& count) {
    FitReport report = SampleReport();
    report.refine.starts.resize(starts, {"random", 9e-4, 7.8e-4, false});
    report.refine.local_optima = count;
    golden.AddChanges(title, FullReport(report));
  };
  golden.Add("no effects", FullReport(SampleReport()));
  add("two seen once", 49, {14, 3, 6, {14, 3, 6, 2, 0}, 1});
  add("some near an earlier end", 49, {14, 3, 6, {9, 2, 4, 1, 0}, 0});
  add("too few independent ones", 49, {5, 1, 5, {2, 1, 0, 0, 1}, kUnknown});
  add("interrupted before the best", 49, {5, 1, 0, {5, 1, 0, 0, 0}, 0});
  add("all in one", 14, {14, 1, 14, {14, 1, 14, 0, 0}, 0});
  add("one end", 14, {1, 1, 1, {1, 1, 1, 1, 0}, kUnknown});
  add("interrupted at once", 14, {});
  golden.Check();
}

TEST(FullReport, TakesAnEmptyReport) {
  FitReport report;
  report.measured = report.simulated = {kUnknown, kUnknown, kUnknown, kUnknown, kUnknown, kUnknown};
  EXPECT_FALSE(FullReport(report).empty());
  EXPECT_FALSE(BriefReport(report).empty());
}

TEST(FitDocument, IsTheTextOfTheReport) {
  EXPECT_EQ(DrawText(FitDocument(SampleReport())), FullReport(SampleReport()));
}

TEST(ShortReport, HasTheVerdictFirstInTwoDozenLines) {
  Golden golden("fit_short");
  FitReport report = SampleReport();
  golden.Add("equal errors", ShortReport(report));
  EXPECT_LE(LinesOf(ShortReport(report)).size(), 24U);
  report.errors = ErrorReport{};
  report.errors->believed = true;
  report.under_errors = report.estimates;
  for (Estimate& e : report.under_errors) {
    e.standard_error *= 2;
    e.low_95 -= e.standard_error;
    e.high_95 += e.standard_error;
  }
  report.errors->sizes = {5e-4, 2e-3, 0, 1, 0};
  report.errors->voltage_effect_A = 4e-3;
  report.errors->part_effect_A = 0;
  golden.AddChanges("noise of the voltage", ShortReport(report));
  report.errors->voltage_effect_A = 1e-4;
  report.errors->part_effect_A = 2e-3;
  golden.AddChanges("noise in proportion to the current", ShortReport(report));
  report.errors->sizes.path = 2e-3;
  golden.AddChanges("a path", ShortReport(report));
  golden.Check();
}

// Whatever the tests of the residuals say, one report says one thing.
TEST(ShortReport, NeverCallsErrorsSharedAndIndependent) {
  for (const double path : {0.0, 2e-3}) {
    for (const double p : {1e-4, 0.03, 0.8}) {
      FitReport report = SampleReport();
      report.errors = ErrorReport{};
      report.errors->believed = true;
      report.errors->sizes.path = path;
      report.residuals.runs = 5;
      report.residuals.runs_p_value = p;
      const std::string text = ShortReport(report);
      EXPECT_NE(text.find("go together") == std::string::npos,
                text.find("independent") == std::string::npos)
          << text;
    }
  }
}

TEST(BriefReport, IsOneLine) {
  Golden golden("fit_brief");
  FitReport report = SampleReport();
  const auto add = [&](const std::string& title) {
    const std::string text = BriefReport(report);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
    golden.AddLong(title, text);
  };
  add("one diode");
  report.usable = false;
  report.not_usable_because = "the curve has a step near 25 V";
  add("not usable");
  golden.Check();
}

TEST(FitsDocument, SaysWhatTheGoldenFileHas) {
  Golden golden("fits");
  golden.AddLong("three files, one of them broken", DrawText(FitsDocument(SampleFits())));
  golden.Add("broken files alone", DrawText(FitsDocument({{"a.csv", Fail("empty")}})));
  golden.Check();
}

}  // namespace
}  // namespace lyrefit
