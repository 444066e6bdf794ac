#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "diagnose/sample_diagnosis.h"
#include "family/sample_family.h"
#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/family/family_documents.h"
#include "lyrefit/report/html_parts.h"
#include "lyrefit/report/plots.h"
#include "sample_report.h"

namespace lyrefit {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

Json Chart(const Figure& figure) { return Json::parse(PlotlyJson(figure)); }

// The traces with at least two points.
std::vector<Json> Traces(const Json& chart) {
  std::vector<Json> traces;
  for (const Json& trace : chart.at("data")) {
    if (trace.at("x").size() > 1) traces.push_back(trace);
  }
  return traces;
}

Figure OnePanel(Series series) {
  Panel panel{"panel", {"Voltage (V)"}, {"Current (mA)"}};
  panel.series = {std::move(series)};
  return {"title", {}, {panel}};
}

Series Steps(SeriesKind kind) {
  Series series{kind, {kBlue, 2, 9}, 1.5, 0.8};
  for (const double x : {1, 2, 3, 4}) series.Add(x, x * x);
  return series;
}

TEST(PlotlyJson, ShowsTheSameReadingsInTheSameColours) {
  const FitReport report = SampleReport();
  const Json chart = Chart(FitFigure(report));
  const std::vector<Json> traces = Traces(chart);
  ASSERT_EQ(traces.size(), 6u);  // I and P, measured and model; residuals with their stems
  EXPECT_EQ(traces[0].at("x").get<std::vector<double>>(), report.curve.voltage_V);
  EXPECT_EQ(traces[0].at("mode"), "markers");
  EXPECT_EQ(traces[0].at("marker").at("symbol"), "circle-open");
  EXPECT_EQ(traces[0].at("marker").at("color"), kBlue);
  EXPECT_EQ(traces[0].at("name"), "I measured");
  EXPECT_EQ(traces[1].at("yaxis"), "y3");  // power, on the right
  EXPECT_EQ(traces[2].at("name"), "I model");
  EXPECT_EQ(traces[2].at("x").size(), 500u);
  EXPECT_EQ(traces[3].at("line").at("dash"), "dash");
  EXPECT_EQ(traces[4].at("yaxis"), "y2");
  // The axis in % of Isc has no trace of its own; an additional one makes Plotly show it.
  EXPECT_EQ(chart.at("data").back().at("yaxis"), "y4");
}

TEST(PlotlyJson, SaysValuesWithTheirUnits) {
  const std::vector<Json> traces = Traces(Chart(OnePanel(Steps(SeriesKind::kLine))));
  EXPECT_EQ(traces[0].at("hovertemplate"), "%{x:.5~g} V<br>%{y:.5~g} mA<extra></extra>");
}

TEST(PlotlyJson, BreaksLinesWhereStretchesEnd) {
  Series series = Steps(SeriesKind::kLine);
  series.EndLine();
  series.Add(9, 9);
  const std::vector<Json> traces = Traces(Chart(OnePanel(series)));
  EXPECT_EQ(traces[0].at("x"), Json({1, 2, 3, 4, nullptr, 9}));
  EXPECT_EQ(traces[0].at("line").at("dash"), "dash");
}

TEST(PlotlyJson, DrawsStemsFromZero) {
  const std::vector<Json> traces = Traces(Chart(OnePanel(Steps(SeriesKind::kStems))));
  EXPECT_EQ(traces[0].at("x").size(), 12u);
  EXPECT_EQ(traces[0].at("y")[3], 0);
  EXPECT_EQ(traces[0].at("y")[4], 4);
  EXPECT_TRUE(traces[0].at("y")[5].is_null());
}

TEST(PlotlyJson, DrawsBoxesFromQuartilesAndWhatLiesFarOut) {
  Series series{SeriesKind::kBox, {kBlue}, 0.4};
  for (const double y : {1, 2, 3, 4, 5, 100}) series.Add(7, y);
  const std::vector<Json> traces = Traces(Chart(OnePanel(series)));
  ASSERT_EQ(traces.size(), 2u);
  const Json& box = traces[0];
  EXPECT_DOUBLE_EQ(box.at("x")[0], 6.8);
  EXPECT_DOUBLE_EQ(box.at("y")[0], 2.25);
  EXPECT_DOUBLE_EQ(box.at("y")[2], 4.75);
  EXPECT_DOUBLE_EQ(box.at("y")[6], 3.5);  // the median
  EXPECT_DOUBLE_EQ(box.at("y")[9], 2.25);
  EXPECT_DOUBLE_EQ(box.at("y")[10], 1);
  EXPECT_DOUBLE_EQ(box.at("y")[13], 5);
  EXPECT_DOUBLE_EQ(traces[1].at("y").back(), 100);
}

TEST(PlotlyJson, DrawsBarsFromZeroAndCellsAroundTheirPlace) {
  Series bars = Steps(SeriesKind::kBars);
  bars.texts = {"one", "<b>two", "three", "four"};
  const std::vector<Json> one = Traces(Chart(OnePanel(bars)));
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].at("type"), "bar");
  EXPECT_EQ(one[0].at("y"), Json({1, 4, 9, 16}));
  EXPECT_EQ(one[0].at("width"), 1.5);
  EXPECT_EQ(one[0].at("marker").at("color"), kBlue);
  EXPECT_EQ(one[0].at("hovertext")[1], "&lt;b&gt;two");
  Series cells{SeriesKind::kCells, {""}, 0.9};
  cells.Add(0, 1, 20);
  cells.Add(1, 1, 40);
  Figure figure = OnePanel(cells);
  figure.colour_bar = ColourBar{"temperature (C)", 20, 40};
  const Json cell = Traces(Chart(figure)).at(0);
  EXPECT_DOUBLE_EQ(cell.at("base")[0], 1 - 0.5 * kCellHeight);
  EXPECT_DOUBLE_EQ(cell.at("y")[0], kCellHeight);
  EXPECT_EQ(cell.at("marker").at("color"), Json({"#0072b2", "#d55e00"}));
}

TEST(PlotlyJson, SaysWhichRowsOfTheTableAPartStandsFor) {
  Series bars = Steps(SeriesKind::kBars);
  EXPECT_FALSE(Traces(Chart(OnePanel(bars))).at(0).contains("customdata"));
  bars.filter_columns = {"id", "zone"};
  bars.filters = {{"^a/", "!pass"}, {"^b/", ""}, {"^c/", ""}, {"^d/", ""}};
  const Json trace = Traces(Chart(OnePanel(bars))).at(0);
  EXPECT_EQ(trace.at("meta"), Json({"id", "zone"}));
  EXPECT_EQ(trace.at("customdata"), Json(bars.filters));
}

TEST(PlotlyJson, ColoursLinesAndPointsByTheirThirdNumber) {
  const SampleFamily family = MakeSampleFamily(8);
  const Json chart = Chart(FamilyFigure(family.report, family.set));
  const Json& bar = chart.at("layout").at("coloraxis");
  EXPECT_LT(bar.at("cmin"), bar.at("cmax"));
  bool points = false, lines = false;
  for (const Json& trace : Traces(chart)) {
    if (trace.contains("line")) {
      EXPECT_EQ(trace.at("line").at("color").get<std::string>().size(), 7u);
      lines = true;
    } else if (trace.at("marker").at("color").is_array()) {
      EXPECT_EQ(trace.at("marker").at("color").size(), trace.at("x").size());
      points = true;
    }
  }
  EXPECT_TRUE(points && lines);
}

TEST(PlotlyJson, HasBandsWhereCausesActAndTheirTitles) {
  const Diagnosis diagnosis = SampleDiagnosis();
  const Figure figure = DiagnosisFigure(diagnosis);
  const Json layout = Chart(figure).at("layout");
  std::size_t upright = 0, titles = 0;
  for (const Json& shape : layout.at("shapes")) {
    if (shape.at("type") == "rect" && shape.at("yref") == "y domain") {
      EXPECT_EQ(shape.at("x0"), figure.panels[0].bands[upright].low);
      EXPECT_EQ(shape.at("fillcolor"), figure.panels[0].bands[upright].colour);
      ++upright;
    }
  }
  EXPECT_EQ(upright, figure.panels[0].bands.size());
  EXPECT_GT(upright, 0u);
  for (const Json& note : layout.at("annotations")) {
    titles += note.at("text") == diagnosis.verdict.causes[0].title ? 1 : 0;
  }
  EXPECT_EQ(titles, 1u);
}

TEST(PlotlyJson, HasTheAxesOfTheFigure) {
  Figure figure = OnePanel(Steps(SeriesKind::kPoints));
  Panel& panel = figure.panels[0];
  panel.x.low = 0.5;
  panel.x.high = 5;
  panel.y.log = true;
  panel.y.low = 0.1;
  panel.rules = {{10, "black", 3, 1}};
  panel.bands = {{false, 1, 2}};
  panel.x.ticks = {{"one <b>", 1}};
  panel.x.slanted = true;
  const Json layout = Chart(figure).at("layout");
  EXPECT_EQ(layout.at("xaxis").at("range"), Json({0.5, 5.0}));
  EXPECT_EQ(layout.at("xaxis").at("ticktext"), Json({"one &lt;b&gt;"}));
  EXPECT_EQ(layout.at("xaxis").at("tickangle"), -40);
  EXPECT_EQ(layout.at("yaxis").at("type"), "log");
  EXPECT_DOUBLE_EQ(layout.at("yaxis").at("range")[0], -1);
  EXPECT_TRUE(layout.at("yaxis").at("range")[1].is_null());
  EXPECT_EQ(layout.at("shapes")[0].at("y1"), 2);
  EXPECT_EQ(layout.at("shapes")[1].at("line").at("dash"), "dot");
}

TEST(PlotlyJson, MakesRoomBeyondTheDataWhereTheFigureDoes) {
  Figure figure = OnePanel(Steps(SeriesKind::kPoints));
  figure.panels[0].y.tight = true;
  figure.panels[0].y.air_low = 0.2;
  const Json range = Chart(figure).at("layout").at("yaxis").at("range");
  EXPECT_DOUBLE_EQ(range[0], 1 - 0.2 * 15);
  EXPECT_DOUBLE_EQ(range[1], 16);
}

TEST(PlotlyJson, KeepsASingleEndOfAnAxis) {
  Figure figure = OnePanel(Steps(SeriesKind::kBars));
  figure.panels[0].y.low = 0;
  const Json axis = Chart(figure).at("layout").at("yaxis");
  EXPECT_EQ(axis.at("range"), Json({0.0, nullptr}));
  EXPECT_EQ(axis.at("autorangeoptions").at("minallowed"), 0.0);
}

TEST(PlotlyJson, StandsSlantedNamesUprightInNarrowPages) {
  Figure figure = OnePanel(Steps(SeriesKind::kBars));
  figure.panels[0].x.slanted = true;
  figure.margin_below = 50;
  const Json chart = Chart(figure);
  EXPECT_FALSE(chart.at("wide").contains("xaxis.tickangle"));
  EXPECT_EQ(chart.at("narrow").at("xaxis.tickangle"), -90);
  EXPECT_GT(chart.at("narrow").at("height"), chart.at("wide").at("height"));
}

// Panels do not overlap, in one column or in several.
TEST(PlotlyJson, PlacesPanelsForWideAndNarrowPages) {
  const SampleFamily family = MakeSampleFamily(8);
  const Json chart = Chart(FamilyFigure(family.report, family.set));
  EXPECT_EQ(chart.at("columns"), 3);
  const Json& wide = chart.at("wide");
  EXPECT_LT(wide.at("xaxis.domain")[1], wide.at("xaxis2.domain")[0]);
  EXPECT_LT(wide.at("xaxis2.domain")[1], wide.at("xaxis3.domain")[0]);
  EXPECT_EQ(wide.at("yaxis.domain"), wide.at("yaxis3.domain"));
  const Json& narrow = chart.at("narrow");
  EXPECT_EQ(narrow.at("xaxis.domain"), Json({0.0, 1.0}));
  EXPECT_GT(narrow.at("yaxis.domain")[0], narrow.at("yaxis2.domain")[1]);
  EXPECT_GT(narrow.at("yaxis2.domain")[0], narrow.at("yaxis3.domain")[1]);
  EXPECT_GE(narrow.at("yaxis3.domain")[0], 0.0);
  EXPECT_GT(narrow.at("height"), 2 * wide.at("height").get<double>());
}

TEST(PlotlyJson, ZoomsPanelsOfOneVoltageTogether) {
  const Json layout = Chart(DiagnosisFigure(SampleDiagnosis())).at("layout");
  EXPECT_FALSE(layout.at("xaxis").contains("matches"));
  EXPECT_EQ(layout.at("xaxis2").at("matches"), "x");
}

TEST(PlotlyJson, TakesNamesForLetters) {
  Figure figure = OnePanel(Steps(SeriesKind::kLine));
  figure.title = "<a href=\"x\">&\x01\xff";
  figure.panels[0].series[0].name = "%{x}<b>";
  figure.legend = {{"<i>", {kBlue}, LegendMark::kLine}};
  const std::string json = PlotlyJson(figure);
  ASSERT_TRUE(Json::accept(json));
  EXPECT_THAT(json, Not(HasSubstr("<a ")));
  EXPECT_THAT(json, Not(HasSubstr("<i>")));
  EXPECT_THAT(json, Not(HasSubstr("<b>")));
  EXPECT_THAT(json, HasSubstr("<extra>%&#123;x}&lt;b&gt;</extra>"));
}

TEST(PlotlyJson, DrawsNoMoreThanThePictureDoes) {
  Series series{SeriesKind::kPoints, {kBlue}};
  for (int i = 0; i < 100000; ++i) series.Add(i, std::sin(0.001 * i));
  const std::vector<Json> traces = Traces(Chart(OnePanel(series)));
  EXPECT_LE(traces[0].at("x").size(), 6000u);
  EXPECT_EQ(traces[0].at("x").back(), 99999);
}

}  // namespace
}  // namespace lyrefit
