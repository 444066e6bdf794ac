#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "diagnose/sample_diagnosis.h"
#include "family/sample_family.h"
#include "golden.h"
#include "json_keys.h"
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

TEST(PlotlyJson, DrawsEveryKindOfSeriesAndTheAxesOfTheFigure) {
  Golden golden("json_charts");
  const auto add = [&golden](const char* title, const Figure& figure) {
    golden.AddLong(title, Outline(Chart(figure)));
  };
  Series line = Steps(SeriesKind::kLine);
  line.EndLine();
  line.Add(9, 9);
  golden.AddLong("a line in two stretches", Outline(Chart(OnePanel(line)).at("data")));
  golden.AddLong("stems", Chart(OnePanel(Steps(SeriesKind::kStems))).at("data")[0].dump());
  Series box{SeriesKind::kBox, {kBlue}, 0.4};
  for (const double y : {1, 2, 3, 4, 5, 100}) box.Add(7, y);
  for (const Json& trace : Traces(Chart(OnePanel(box)))) {
    golden.AddLong("a box and what lies far out", trace.at("x").dump() + trace.at("y").dump());
  }
  Series bars = Steps(SeriesKind::kBars);
  bars.texts = {"one", "<b>two", "three", "four"};
  bars.filter_columns = {"id", "zone"};
  bars.filters = {{"^a/", "!pass"}, {"^b/", ""}, {"^c/", ""}, {"^d/", ""}};
  golden.AddLong("bars with rows of a table", Outline(Chart(OnePanel(bars)).at("data")));
  Series cells{SeriesKind::kCells, {""}, 0.9};
  cells.Add(0, 1, 20);
  cells.Add(1, 1, 40);
  Figure figure = OnePanel(cells);
  figure.colour_bar = ColourBar{"temperature (C)", 20, 40};
  golden.AddLong("cells", Outline(Chart(figure).at("data")));
  figure = OnePanel(Steps(SeriesKind::kPoints));
  Panel& panel = figure.panels[0];
  panel.x.low = 0.5;
  panel.x.high = 5;
  panel.y.log = true;
  panel.y.low = 0.1;
  panel.rules = {{10, "black", 3, 1}};
  panel.bands = {{false, 1, 2}};
  panel.x.ticks = {{"one <b>", 1}};
  panel.x.slanted = true;
  add("axes", figure);
  const auto axis_y = [](const Figure& drawn) {
    return Outline(Chart(drawn).at("layout").at("yaxis"));
  };
  figure = OnePanel(Steps(SeriesKind::kPoints));
  figure.panels[0].y.tight = true;
  figure.panels[0].y.air_low = 0.2;
  golden.AddLong("room beyond the data", axis_y(figure));
  figure = OnePanel(Steps(SeriesKind::kBars));
  figure.panels[0].y.low = 0;
  golden.AddLong("a single end of an axis", axis_y(figure));
  figure = OnePanel(Steps(SeriesKind::kBars));
  figure.panels[0].x.slanted = true;
  figure.margin_below = 50;
  golden.AddLong("slanted names, wide", Outline(Chart(figure).at("wide")));
  golden.AddLong("slanted names, upright in narrow pages", Outline(Chart(figure).at("narrow")));
  golden.Check();
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
