#include "lyrefit/report/plots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>

#include "error_of.h"
#include "sample_report.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

int FilesIn(const fs::path& folder) {
  return static_cast<int>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(FitFigure, LabelsTheRmseByTheFittedObjective) {
  FitReport report = SampleReport();
  EXPECT_THAT(FigureScript(FitFigure(report), "svg"), HasSubstr("RMSE 0.000773 A solved-current'"));
  report.objective = Objective::kMeasuredCurrent;
  EXPECT_THAT(FigureScript(FitFigure(report), "svg"),
              HasSubstr("RMSE 0.0009891 A measured-current'"));
}

TEST(FitFigure, SaysInterruptedAndNotPolished) {
  FitReport report = SampleReport();
  report.interrupted = true;
  report.polished = false;
  EXPECT_THAT(FigureScript(FitFigure(report), "png"),
              HasSubstr("model, interrupted: RMSE 0.000776 A"));
  EXPECT_THAT(FigureScript(FitFigure(report), "png"), HasSubstr("solved-current, not polished'"));
}

TEST(FitFigure, LeavesOutWhatIsNotFinite) {
  FitReport report = SampleReport();
  report.residual_A[3] = kUnknown;
  EXPECT_THAT(FigureScript(FitFigure(report), "svg"), Not(HasSubstr("nan")));
}

// Position of zero on an axis: 0 at its lower end, 1 at its upper end.
double ZeroOf(const Axis& axis) { return -axis.low / (axis.high - axis.low); }

// Whether the zero of the right axis is drawn.
bool HasZeroOfTheRight(const Panel& panel) {
  return std::any_of(panel.rules.begin(), panel.rules.end(),
                     [](const Rule& rule) { return rule.right_axis && rule.y == 0; });
}

// A long tail beyond open circuit, where the power is more negative than the current.
TEST(FitFigure, HasTheZerosOfBothAxesAtOneHeightOrDrawsBoth) {
  FitReport report = SampleReport();
  report.curve.current_A.back() = -4;
  const Panel tail = FitFigure(report).panels[0];
  EXPECT_NEAR(ZeroOf(tail.y), ZeroOf(*tail.right), 1e-9);
  EXPECT_FALSE(HasZeroOfTheRight(tail));
  // Deep reverse bias: large negative power without negative current.
  report = SampleReport();
  report.curve.voltage_V.front() = -40;
  EXPECT_TRUE(HasZeroOfTheRight(FitFigure(report).panels[0]));
}

TEST(FitFigure, ShowsResidualsInPercentOfTheShortCircuitCurrent) {
  const FitReport report = SampleReport();
  const Panel residuals = FitFigure(report).panels[1];
  ASSERT_TRUE(residuals.right);
  EXPECT_EQ(residuals.right->label, "% of Isc");
  // Isc is 0.76 A, and the left axis is in mA.
  EXPECT_NEAR(residuals.right->high / residuals.y.high, 0.1 / 0.7603, 1e-4);
  EXPECT_NEAR(ZeroOf(*residuals.right), ZeroOf(residuals.y), 1e-12);
}

TEST(FitFigure, HasNoPercentInTheDark) {
  FitReport report = SampleReport();
  report.refined[kIph] = 0;
  EXPECT_FALSE(FitFigure(report).panels[1].right);
}

TEST(FitFigure, DrawsTheModelAboveAllPoints) {
  const Panel panel = FitFigure(SampleReport()).panels[0];
  ASSERT_EQ(panel.series.size(), 4U);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(panel.series[i].kind == SeriesKind::kPoints, i < 2);
}

TEST(FitFigure, DrawsNoMoreMarksThanCanBeToldApart) {
  FitReport report = SampleReport();
  for (int i = 0; i < 12; ++i) {
    for (auto* values : {&report.curve.voltage_V, &report.curve.current_A, &report.residual_A,
                         &report.model_current_A}) {
      const std::vector<double> copy = *values;
      values->insert(values->end(), copy.begin(), copy.end());
    }
  }
  ASSERT_GT(report.curve.size(), 100000U);
  EXPECT_LT(FigureScript(FitFigure(report), "svg").size(), 300000U);
  const TempFolder folder;
  ASSERT_TRUE(PlotFit(report, folder.Path("fit.svg")));
  EXPECT_LT(FileText(folder.Path("fit.svg")).size(), 1000000U);
  EXPECT_GT(FigureScript(FitFigure(report), "svg", PlotPoints::kAll).size(), 3000000U);
}

TEST(PlotFit, WritesAnSvgWithItsLabels) {
  const TempFolder folder;
  const std::string path = folder.Path("fit.svg");
  const auto drawn = PlotFit(SampleReport(), path);
  ASSERT_TRUE(drawn) << drawn.error().ToString();
  const std::string svg = FileText(path);
  EXPECT_THAT(svg, HasSubstr("<svg"));
  EXPECT_THAT(svg, HasSubstr("</svg>"));
  EXPECT_THAT(svg, HasSubstr("sample_cell, single-diode model: RMSE 0.000773 A solved-current"));
  EXPECT_THAT(svg, HasSubstr("Voltage (V)"));
  EXPECT_THAT(svg, HasSubstr("Model - measured (mA)"));
  EXPECT_EQ(FilesIn(folder.Path("")), 1);
}

TEST(PlotFit, WritesAPng) {
  const TempFolder folder;
  const std::string path = folder.Path("fit.PNG");
  const auto drawn = PlotFit(SampleReport(), path);
  ASSERT_TRUE(drawn) << drawn.error().ToString();
  EXPECT_EQ(FileText(path).substr(0, 8), "\x89PNG\r\n\x1a\n");
}

TEST(PlotFit, WritesAPdfThatIsTheSameAtAnyTime) {
  const TempFolder folder;
  const auto drawn = PlotFit(SampleReport(), folder.Path("fit.pdf"));
  ASSERT_TRUE(drawn) << drawn.error().ToString();
  const std::string pdf = FileText(folder.Path("fit.pdf"));
  EXPECT_THAT(pdf, ::testing::StartsWith("%PDF-"));
  EXPECT_THAT(pdf, ::testing::EndsWith("%%EOF\n"));
  EXPECT_THAT(pdf, HasSubstr("/MediaBox [ 0 0 "));
  EXPECT_THAT(pdf, HasSubstr("/CreationDate (D:20000101000000"));
}

TEST(PlotFit, TakesAnyNameAndPath) {
  const TempFolder folder;
  FitReport report = SampleReport();
  report.curve.name = "it's \"50 %\" <cell> & $x `rm` \\n\nset output";
  const std::string path = folder.Path("a 'b' $c.svg");
  const auto drawn = PlotFit(report, path);
  ASSERT_TRUE(drawn) << drawn.error().ToString();
  EXPECT_THAT(FileText(path), HasSubstr("&lt;cell> &amp; $x `rm` \\n set output"));
}

TEST(PlotFit, DrawsDarkAndTinyCurves) {
  const TempFolder folder;
  FitReport report = SampleReport();
  report.refined[kIph] = 0;
  report.model_current_A =
      SolveCurrents(report.device, report.refined.data(), report.curve.voltage_V);
  report.curve.current_A = report.model_current_A;
  report.residual_A.assign(report.curve.size(), 0);
  report.rmse.refined = {0, 0};
  const auto drawn = PlotFit(report, folder.Path("dark.svg"));
  EXPECT_TRUE(drawn) << drawn.error().ToString();
}

TEST(PlotFit, RefusesOtherExtensions) {
  const TempFolder folder;
  for (const char* name : {"fit.gif", "fit"}) {
    EXPECT_THAT(MessageOf(PlotFit(SampleReport(), folder.Path(name))),
                HasSubstr(".svg, .png or .pdf"));
  }
  EXPECT_EQ(FilesIn(folder.Path("")), 0);
}

TEST(PlotFit, RefusesAFolderThatIsNotThere) {
  const TempFolder folder;
  EXPECT_FALSE(PlotFit(SampleReport(), folder.Path("no/fit.svg")));
  EXPECT_EQ(FilesIn(folder.Path("")), 0);
}

TEST(CheckPlot, SaysWhatToInstallWithoutGnuplot) {
  const TempFolder folder;
  EXPECT_TRUE(CheckPlot("fit.svg"));
  const std::string path = std::getenv("PATH");
  ASSERT_EQ(setenv("PATH", folder.Path("").c_str(), 1), 0);
  const auto checked = CheckPlot("fit.svg");
  const auto drawn = PlotFit(SampleReport(), folder.Path("fit.svg"));
  ASSERT_EQ(setenv("PATH", path.c_str(), 1), 0);
  ASSERT_FALSE(checked);
  EXPECT_THAT(checked.error().message, HasSubstr("gnuplot-nox"));
  EXPECT_FALSE(drawn);
  EXPECT_EQ(FilesIn(folder.Path("")), 0);
}

}  // namespace
}  // namespace lyrefit
