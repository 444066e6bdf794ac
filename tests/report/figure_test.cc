#include "lyrefit/report/figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "error_of.h"
#include "lyrefit/report/figure_parts.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// One panel with a line of two points.
Figure SampleFigure() {
  Series series;
  series.Add(1, 2);
  series.Add(3, 4);
  Panel panel{"panel"};
  panel.series = {series};
  return {"title", {}, {panel}};
}

std::string Svg(const Figure& figure) {
  const auto svg = RunGnuplot(FigureScript(figure, "svg"));
  EXPECT_TRUE(svg) << svg.error().ToString();
  return svg.value_or("");
}

// Number of data rows in a gnuplot script, without the rows that end a line.
int Rows(const std::string& script) {
  int rows = 0;
  std::size_t at = 0;
  while ((at = script.find("<< END_OF_DATA\n", at)) != std::string::npos) {
    const std::size_t end = script.find("\nEND_OF_DATA\n", at);
    for (std::size_t i = at + 14; i < end; ++i) rows += script[i] == '\n' && script[i + 1] != '\n';
    at = end;
  }
  return rows;
}

TEST(Figure, ChoosesTheTerminal) {
  EXPECT_THAT(FigureScript(SampleFigure(), "svg"), HasSubstr("set terminal svg"));
  EXPECT_THAT(FigureScript(SampleFigure(), "png"), HasSubstr("set terminal pngcairo"));
}

TEST(Figure, DrawsEveryKindOfSeriesAndAllBesideThem) {
  Figure figure = SampleFigure();
  Panel& panel = figure.panels[0];
  for (const SeriesKind kind : {SeriesKind::kPoints, SeriesKind::kLineAndPoints, SeriesKind::kStems,
                                SeriesKind::kBox, SeriesKind::kBars, SeriesKind::kCells}) {
    panel.series.push_back(panel.series[0]);
    panel.series.back().kind = kind;
    panel.series.back().name = "series " + std::to_string(static_cast<int>(kind));
  }
  panel.series[1].look.colour = "";
  panel.series[2].right_axis = true;
  panel.series[6].look.colour = "";
  panel.right = Axis{"right label"};
  panel.x.label = "x label";
  panel.y.label = "y label";
  panel.rules = {{3, "#123456", 3, 0.8}};
  panel.bands = {{true, 1, 2, "#654321"}, {false, 2, 3}};
  panel.notes = {{"a note", "#abcdef", 0.5, 0.1}};
  panel.zero_line = true;
  figure.legend = LegendOf({"one", "two"}, LegendMark::kLineAndPoint);
  figure.legend.push_back({"three", LookOf(2), LegendMark::kBox});
  figure.colour_bar = ColourBar{"temperature", 20, 40};
  const std::string svg = Svg(figure);
  for (const char* text :
       {">title<", ">panel<", ">x label<", ">y label<", ">right label<", ">a note<", ">one<",
        ">three<", ">temperature<", "<title>series 2</title>", "18,  52,  86", "101,  67,  33"}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
}

TEST(Figure, WithoutDataIsAnEmptyPanel) {
  Figure figure = SampleFigure();
  figure.panels[0].series[0].rows.clear();
  EXPECT_THAT(Svg(figure), HasSubstr(">panel<"));
  figure.panels[0].x.log = true;
  figure.panels[0].y.low = 0;
  EXPECT_THAT(Svg(figure), HasSubstr(">panel<"));
}

// Each panel sets or unsets all its properties, so that none is inherited from the panel before.
TEST(Figure, HasPanelsThatKnowNothingOfEachOther) {
  const Figure plain = SampleFigure();
  Figure figure = SampleFigure();
  Panel& first = figure.panels[0];
  first.x.log = first.y.tight = first.zero_line = true;
  first.x.ticks = {{"here", 1}};
  first.x.slanted = true;
  first.right = Axis{"right", 0, 1};
  figure.panels.push_back(plain.panels[0]);
  const auto after = [](const std::string& script) {
    return script.substr(script.find("set title 'panel'", script.find("set title") + 1));
  };
  const std::string svg = Svg(figure);
  const std::string second = svg.substr(svg.rfind(">here<"));
  EXPECT_THAT(second, HasSubstr("> 1.5<"));
  EXPECT_THAT(after(FigureScript(figure, "svg")), HasSubstr("unset logscale x"));
  EXPECT_THAT(after(FigureScript(figure, "svg")), HasSubstr("unset y2tics"));
}

TEST(Figure, HasTheTicksThatAreAskedForBelowZeroToo) {
  Figure figure = SampleFigure();
  Axis& x = figure.panels[0].x;
  x.low = -4.5;
  x.high = 4.5;
  x.first_tick = -3;
  x.tick_step = 3;
  const std::string svg = Svg(figure);
  for (const char* shown : {"-3<", " 0<", " 3<"}) EXPECT_THAT(svg, HasSubstr(shown));
  EXPECT_THAT(svg, Not(HasSubstr("-4<")));
}

TEST(Figure, QuotesText) {
  EXPECT_EQ(GnuplotText("it's\n$x"), "'it''s $x'");
  Figure figure = SampleFigure();
  figure.title = "it's {a}_b";
  figure.panels[0].series[0].name = "x_{y}'";
  figure.panels[0].x.ticks = {{"q'_{z}", 2}};
  figure.panels[0].x.slanted = true;
  const std::string svg = Svg(figure);
  EXPECT_THAT(svg, HasSubstr("{a}_b"));
  EXPECT_THAT(svg, HasSubstr("_{z}"));
}

TEST(Figure, StandsPanelsRowByRow) {
  Figure figure = SampleFigure();
  figure.panels.resize(5, figure.panels[0]);
  figure.columns = 2;
  figure.panels[2].height = 100;
  const PageLayout page = LayOut(figure);
  EXPECT_EQ(page.top[0], page.top[1]);
  EXPECT_LT(page.top[1], page.top[2]);
  EXPECT_EQ(page.top[2], page.top[3]);
  EXPECT_EQ(page.top[4] - page.top[2], page.top[2] - page.top[0] - 200);
  EXPECT_GT(page.height, page.top[4] + 300);
  figure.columns = 9;  // more columns than panels
  EXPECT_EQ(LayOut(figure).columns, 5);
}

TEST(Figure, MakesRoomForARightAxisAndTheLegend) {
  Figure figure = SampleFigure();
  const PageLayout before = LayOut(figure);
  figure.panels[0].right = Axis{"right"};
  figure.legend =
      LegendOf(std::vector<std::string>(40, "a long name of a line"), LegendMark::kLine);
  EXPECT_GT(LayOut(figure).width, before.width);
  EXPECT_GT(LayOut(figure).height, before.height + 200);
}

TEST(Figure, TellsManyLinesApart) {
  std::set<std::pair<std::string, int>> looks;
  for (int i = 0; i < 32; ++i) looks.emplace(LookOf(i).colour, LookOf(i).dash);
  EXPECT_EQ(looks.size(), 32U);
}

TEST(Series, LeavesOutWhatIsNotFinite) {
  Series series;
  series.Add(kUnknown, 1);
  series.Add(1, kInfinity);
  series.Add(1, 1, kUnknown);
  EXPECT_TRUE(series.rows.empty());
  series.Add(1, 1);
  EXPECT_EQ(series.rows.size(), 1U);
}

// Points and lines of many measured curves in several panels.
Figure LargeFigure(int curves, int readings) {
  Panel panel{"panel"};
  for (const SeriesKind kind : {SeriesKind::kPoints, SeriesKind::kLine}) {
    Series series;
    series.kind = kind;
    for (int c = 0; c < curves; ++c) {
      for (int i = 0; i < readings; ++i) {
        series.Add(i, std::sin(0.001 * i) + c + 1e-3 * (i * 7919 % 1000));
      }
      series.EndLine();
    }
    panel.series.push_back(series);
  }
  return {"large", {}, {panel, panel, panel}};
}

TEST(LargeFigure, IsLessThanAMegabyteUnlessAllIsAskedFor) {
  for (const int curves : {1, 50}) {
    const Figure figure = LargeFigure(curves, 100000 / curves);
    EXPECT_LT(Svg(figure).size(), 1000000U) << curves;
    EXPECT_EQ(Rows(FigureScript(figure, "svg", PlotPoints::kAll)), 600000) << curves;
  }
}

TEST(LargeFigure, KeepsTheExtremesOfEveryCurve) {
  Figure figure = LargeFigure(20, 5000);
  figure.panels[1].series[0].rows[33333][1] = 777.25;
  EXPECT_THAT(FigureScript(figure, "svg"), HasSubstr(" 777.25 "));
}

TEST(LargeFigure, OfUpToTwoThousandReadingsIsDrawnWhole) {
  EXPECT_EQ(Rows(FigureScript(LargeFigure(1, 2000), "svg")), 12000);
}

// Thinning spaces the marks evenly on the drawn axis, also on a logarithmic one.
TEST(LargeFigure, KeepsTheBeginningOfALogarithmicAxis) {
  Figure figure = SampleFigure();
  Panel& panel = figure.panels[0];
  panel.x.log = true;
  panel.series[0].rows.clear();
  for (int i = 1; i <= 100000; ++i) panel.series[0].Add(i, std::log(i));
  const std::string script = FigureScript(figure, "svg");
  for (const char* row : {"\n2 ", "\n5 ", "\n9 "}) EXPECT_THAT(script, HasSubstr(row));
  EXPECT_LT(Rows(script), 9000);
}

TEST(LargeFigure, TakesQuartilesOfAll) {
  Figure figure = SampleFigure();
  Series& box = figure.panels[0].series[0];
  box.kind = SeriesKind::kBox;
  for (int i = 0; i < 50000; ++i) box.Add(1, i);
  EXPECT_EQ(Rows(FigureScript(figure, "svg")), 50002);
}

using ::testing::Contains;

TEST(MarksToDraw, AreAllOfFewPoints) {
  EXPECT_EQ(MarksToDraw({3, 1, 2}, {0, 0, 0}, 10), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_TRUE(MarksToDraw({}, {}, 10).empty());
}

TEST(MarksToDraw, KeepTheExtremesAndTheEnds) {
  std::vector<double> x(100000), y(100000);
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = 1e-3 * static_cast<double>(i);
    y[i] = std::sin(x[i]);
  }
  y[31417] = 7;   // one outlier up
  y[70001] = -9;  // and one down
  const std::vector<std::size_t> kept = MarksToDraw(x, y);
  EXPECT_LE(kept.size(), kMostMarks + 4);
  EXPECT_GT(kept.size(), kMostMarks / 3);
  for (const std::size_t i : {0, 31417, 70001, 99999}) EXPECT_THAT(kept, Contains(i));
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  // No visible gap: 0.3 of an axis of 100.
  for (std::size_t k = 1; k < kept.size(); ++k) EXPECT_LT(x[kept[k]] - x[kept[k - 1]], 0.3);
}

TEST(MarksToDraw, LeaveOutWhatIsNotFinite) {
  std::vector<double> x(5000), y(5000, 1.0);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = static_cast<double>(i);
  y[17] = std::numeric_limits<double>::quiet_NaN();
  x[18] = std::numeric_limits<double>::infinity();
  const std::vector<std::size_t> kept = MarksToDraw(x, y, 100);
  EXPECT_LE(kept.size(), 104U);
  for (const std::size_t i : kept) EXPECT_TRUE(i != 17 && i != 18);
}

// Keeping only the extremes would exaggerate the spread.
TEST(MarksToDraw, ShowWhatIsUsualToo) {
  std::vector<double> x(50000), y(50000);
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = static_cast<double>(i);
    y[i] = static_cast<double>((i * 7919) % 1000);  // evenly between 0 and 1000
  }
  const std::vector<std::size_t> kept = MarksToDraw(x, y);
  const auto usual =
      std::count_if(kept.begin(), kept.end(), [&](auto i) { return y[i] > 200 && y[i] < 800; });
  EXPECT_GT(usual, static_cast<long>(kept.size()) / 5);
}

TEST(MarksToDraw, OfOneVoltageAreItsLowestAndHighest) {
  std::vector<double> x(5000, 2.0), y(5000);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = static_cast<double>((i * 7919) % 5000);
  const std::vector<std::size_t> kept = MarksToDraw(x, y, 100);
  ASSERT_LE(kept.size(), 6U);
  double low = 1e9, high = -1e9;
  for (const std::size_t i : kept) low = std::min(low, y[i]), high = std::max(high, y[i]);
  EXPECT_EQ(low, 0);
  EXPECT_EQ(high, 4999);
}

using ::testing::HasSubstr;

TEST(RunGnuplot, ReturnsWhatTheScriptPrints) {
  const auto answer = RunGnuplot("set print '-'\nprint 6 * 7\n");
  ASSERT_TRUE(answer) << answer.error().ToString();
  EXPECT_EQ(*answer, "42\n");
}

TEST(RunGnuplot, ReportsTheFirstComplaint) {
  EXPECT_THAT(MessageOf(RunGnuplot("nonsense here\n")), HasSubstr("could not draw the plot"));
}

TEST(RunGnuplot, RefusesAnEmptyPicture) { EXPECT_FALSE(RunGnuplot("x = 1\n")); }

}  // namespace
}  // namespace lyrefit
