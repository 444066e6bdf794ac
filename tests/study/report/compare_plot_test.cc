#include "lyrefit/study/report/documents.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "error_of.h"
#include "lyrefit/study/report/compare_parts.h"
#include "sample_comparison.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// Expects an SVG with balanced opening and closing tags.
void ExpectSoundSvg(const std::string& svg) {
  EXPECT_THAT(svg, HasSubstr("<svg"));
  EXPECT_THAT(svg, EndsWith("</svg>\n\n"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  int depth = 0;
  for (std::size_t i = svg.find("<svg"); i != std::string::npos; i = svg.find('<', i + 1)) {
    const std::size_t end = svg.find('>', i);
    ASSERT_NE(end, std::string::npos);
    if (svg[i + 1] == '!' || svg[i + 1] == '?') continue;
    if (svg[i + 1] == '/') {
      --depth;
    } else if (svg[end - 1] != '/') {
      ++depth;
    }
    ASSERT_GE(depth, 0);
  }
  EXPECT_EQ(depth, 0);
}

TEST(ComparePlots, AreSoundSvg) {
  const TempFolder folder;
  ASSERT_TRUE(PlotBoxes(SampleComparison(), folder.Path("box.svg")));
  ASSERT_TRUE(PlotConvergence(SampleComparison(), folder.Path("course.SVG")));
  for (const char* name : {"box.svg", "course.SVG"}) {
    SCOPED_TRACE(name);
    ExpectSoundSvg(FileText(folder.Path(name)));
  }
}

TEST(ComparePlots, AreDrawnAsPngToo) {
  const TempFolder folder;
  ASSERT_TRUE(PlotBoxes(SampleComparison(), folder.Path("box.png")));
  EXPECT_THAT(FileText(folder.Path("box.png")), StartsWith("\x89PNG"));
}

TEST(ComparePlots, NameAxesPanelsAndAlgorithms) {
  const TempFolder folder;
  ASSERT_TRUE(PlotBoxes(SampleComparison(), folder.Path("box.svg")));
  ASSERT_TRUE(PlotConvergence(SampleComparison(), folder.Path("course.svg")));
  for (const char* name : {"box.svg", "course.svg"}) {
    const std::string svg = FileText(folder.Path(name));
    for (const char* text : {"sample_cell, single diode", "sample_cell, double diode", "random",
                             "RMSE above reference (A, measured-current)"}) {
      EXPECT_THAT(svg, HasSubstr(text)) << name;
    }
  }
  EXPECT_THAT(FileText(folder.Path("box.svg")), HasSubstr("after the polish"));
  EXPECT_THAT(FileText(folder.Path("course.svg")), HasSubstr("Evaluations of the objective"));
}

TEST(ComparePlots, TakeRunsThatAreAllEqualOrEndless) {
  const TempFolder folder;
  Comparison comparison = SampleComparison();
  for (ProblemResult& problem : comparison.problems) {
    for (AlgorithmResult& compared : problem.algorithms) {
      for (RunRecord& run : compared.runs) run.searched_A = run.polished_A = 1e-3;
      compared.trace = {{10, 1e-3}};
    }
    problem.reference.rmse_A = 1e-3;
  }
  comparison.problems[0].algorithms[0].runs[0].searched_A = kInfinity;
  EXPECT_TRUE(PlotBoxes(comparison, folder.Path("box.svg")));
  EXPECT_TRUE(PlotConvergence(comparison, folder.Path("course.svg")));
}

TEST(ComparePlots, DoWithoutAPolish) {
  const TempFolder folder;
  Comparison comparison = SampleComparison();
  comparison.options.polish = false;
  ASSERT_TRUE(PlotBoxes(comparison, folder.Path("box.svg")));
  EXPECT_THAT(FileText(folder.Path("box.svg")), Not(HasSubstr("after the polish")));
}

TEST(ComparePlots, QuoteNamesForGnuplot) {
  Comparison comparison = SampleComparison();
  comparison.problems[0].curve_name = "it's\n_a^b{c}";
  comparison.problems[0].algorithms[0].name = "x_{y}'";
  const TempFolder folder;
  const auto drawn = PlotConvergence(comparison, folder.Path("course.svg"));
  ASSERT_TRUE(drawn) << drawn.error().ToString();
  EXPECT_THAT(FileText(folder.Path("course.svg")), HasSubstr("_a^b{c}, single diode"));
}

TEST(ComparePlots, RefuseOtherExtensionsAndEmptyComparisons) {
  const TempFolder folder;
  EXPECT_THAT(MessageOf(PlotBoxes(SampleComparison(), folder.Path("box.gif"))),
              HasSubstr(".svg, .png or .pdf"));
  Comparison none = SampleComparison();
  none.problems.clear();
  EXPECT_THAT(MessageOf(PlotBoxes(none, folder.Path("box.svg"))), HasSubstr("nothing to draw"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.Path("")));
}

TEST(ComparePlots, KeepTheirLowestLineOffZero) {
  // A logarithmic axis cannot show runs that end at the reference, with an excess of 0.
  EXPECT_THAT(FigureScript(BoxFigure(SampleComparison()), "svg"), Not(HasSubstr("\n0 0\n")));
}

}  // namespace
}  // namespace lyrefit
