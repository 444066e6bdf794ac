#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnose/sample_diagnosis.h"
#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/report/html_parts.h"
#include "lyrefit/report/plots.h"
#include "sample_report.h"
#include "well_formed.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::StartsWith;

TEST(InlineSvgs, NamesEveryPictureForWhoDoesNotSeeIt) {
  Figure figure = FitFigure(SampleReport());
  figure.title = "a < b & 'c'";
  const auto svgs = InlineSvgs({{&figure, "one", "d > e"}});
  ASSERT_TRUE(svgs) << svgs.error().ToString();
  ASSERT_THAT(*svgs, SizeIs(1));
  const std::string& svg = svgs->front();
  EXPECT_THAT(svg, StartsWith("<svg "));
  EXPECT_THAT(svg, HasSubstr("role=\"img\" aria-labelledby=\"one-title one-text\""));
  EXPECT_THAT(svg, HasSubstr("<title id=\"one-title\">a &lt; b &amp; &#39;c&#39;</title>"));
  EXPECT_THAT(svg, HasSubstr("<desc id=\"one-text\">d &gt; e</desc>"));
  if (HasXmlLint()) {
    EXPECT_EQ(Complaints(svg), "");
  }
}

TEST(InlineSvgs, GivesEveryPictureOfAPageItsOwnNames) {
  const Figure fit = FitFigure(SampleReport());
  const Figure diagnosis = DiagnosisFigure(SampleDiagnosis());
  const auto svgs = InlineSvgs({{&fit, "one", ""}, {&diagnosis, "two", ""}});
  ASSERT_TRUE(svgs) << svgs.error().ToString();
  ASSERT_THAT(*svgs, SizeIs(2));
  const std::string page = "<div>" + svgs->at(0) + svgs->at(1) + "</div>";
  if (HasXmlLint()) {
    EXPECT_EQ(Complaints(page), "");
  }
  EXPECT_THAT(svgs->at(0), HasSubstr("xlink:href='#one-gpPt5'"));
  EXPECT_THAT(svgs->at(1), HasSubstr("xlink:href='#two-gpPt"));
  EXPECT_THAT(page, Not(HasSubstr("href='#gp")));
  // Drawing two figures in one gnuplot run gives the result of two runs.
  EXPECT_EQ(InlineSvgs({{&diagnosis, "two", ""}})->front(), svgs->at(1));
}

TEST(InlineSvgs, TakesItsColoursFromThePage) {
  const Figure figure = FitFigure(SampleReport());
  const auto svgs = InlineSvgs({{&figure, "one", ""}});
  ASSERT_TRUE(svgs);
  const std::string& svg = svgs->front();
  EXPECT_THAT(svg, HasSubstr("var(--c-0072b2,#0072b2)"));
  EXPECT_THAT(svg, HasSubstr("fill=\"var(--t-0072b2,#0072b2)\""));  // text
  EXPECT_THAT(svg, HasSubstr("currentColor"));
  EXPECT_THAT(svg, Not(HasSubstr("rgb(")));
  EXPECT_THAT(svg, Not(HasSubstr("\"black\"")));
  EXPECT_THAT(svg, Not(HasSubstr("#ffffff")));
}

TEST(InlineSvgs, HoldsOnlyWhatIsDrawn) {
  Figure lines = FitFigure(SampleReport());
  const std::string with_points = InlineSvgs({{&lines, "one", ""}})->front();
  EXPECT_THAT(with_points, HasSubstr("<defs>"));
  EXPECT_THAT(with_points, Not(HasSubstr("stroke-linejoin")));
  for (Panel& panel : lines.panels) {
    for (Series& series : panel.series) series.kind = SeriesKind::kLine;
  }
  lines.legend.clear();
  EXPECT_THAT(InlineSvgs({{&lines, "one", ""}})->front(), Not(HasSubstr("<defs>")));
}

TEST(InlineSvgs, LeavesLettersAlone) {
  Figure figure = FitFigure(SampleReport());
  figure.panels[0].title = "rgb(  0, 0, 0) id='x' url(#y)";
  const auto svgs = InlineSvgs({{&figure, "one", ""}});
  ASSERT_TRUE(svgs);
  EXPECT_THAT(svgs->front(), HasSubstr("rgb(  0, 0, 0) id='x' url(#y)"));
}

TEST(InlineSvgs, DrawsNothingOfNothing) {
  const auto svgs = InlineSvgs({});
  ASSERT_TRUE(svgs);
  EXPECT_THAT(*svgs, SizeIs(0));
}

}  // namespace
}  // namespace lyrefit
