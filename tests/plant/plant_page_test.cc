#include "plant/plant_page.h"
#include "plant/plant_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "lyrefit/report/page_shell.h"
#include "plant/made_results.h"
#include "plant/read_plant_page.h"
#include "plant/synthetic_rows.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const double kNan = std::numeric_limits<double>::quiet_NaN();

class PlantPageTest : public testing::Test {
 protected:
  std::string File(const std::string& name) const { return folder_.Path(name); }

  std::string PageOf(const std::vector<ResultColumn>& columns, const std::vector<ResultRow>& rows,
                     const std::string& plant = "Plant",
                     const nlohmann::ordered_json& run = nlohmann::ordered_json::object()) const {
    {
      MadeResults results(folder_.Path(""), columns, run);
      for (const ResultRow& row : rows) results.Add(row);
    }
    const auto written = WritePlantPage(folder_.Path(""), File("page.html"), plant);
    EXPECT_TRUE(written) << (written ? "" : written.error().ToString());
    EXPECT_EQ(written.value_or(-1), static_cast<std::int64_t>(rows.size()));
    return FileText(File("page.html"));
  }

  std::string SyntheticPage(std::int64_t rows) const {
    std::vector<ResultRow> made;
    for (std::int64_t row = 0; row < rows; ++row) made.push_back(SyntheticPlantResult(1, row));
    return PageOf(SyntheticPlantColumns(), made);
  }

  std::size_t FilesThere() const {
    return std::distance(std::filesystem::directory_iterator(folder_.Path("")), {});
  }

  TempFolder folder_;
};

std::string VerdictOf(const std::string& html) {
  std::size_t place = 0;
  return plant_page::Between(html, "<h2>Verdict</h2>\n<p>", "</p>", &place);
}

ResultColumn Number(const std::string& name) { return {name, "", CellType::kNumber, ""}; }
ResultColumn Text(const std::string& name) { return {name, "", CellType::kText, ""}; }

TEST_F(PlantPageTest, HoldsTheFileOfTheResultsUnchanged) {
  const std::string html = SyntheticPage(3000);
  EXPECT_EQ(plant_page::Rows(html), FileText(File("results.csv")));
  const json columns = plant_page::Columns(html)["columns"];
  EXPECT_EQ(columns.size(), SyntheticPlantColumns().size());
  EXPECT_EQ(columns[0]["name"], "id");
  const auto power = std::find_if(columns.begin(), columns.end(), [](const json& column) {
    return column["name"] == "Pmax_stc_W";
  });
  EXPECT_TRUE((*power)["number"]);
  EXPECT_TRUE((*power)["shown"]);
}

TEST_F(PlantPageTest, HostileNamesAreTextAndNothingElse) {
  const std::string evil =
      "a\"b'</script><script>alert(1)</script><!--<script type=\"application/gzip\" "
      "id=\"rows\"><img src=x>";
  const std::string head = "</script><script>alert(1)</script><img src=x>";
  const std::vector<ResultColumn> columns = {
      Text("id"),     Text("zone"),   Text("cause"), Text("cause_title"),         Text("page"),
      Text("status"), Text("reason"), Number(head),  Number("performance_factor")};
  const std::string html =
      PageOf(columns,
             {{{evil + "/x", evil, evil, evil, "pages/../" + evil, std::string("fine"),
                ResultCell(), 1.0, 0.5}},
              {{evil + "/y", evil, evil, evil, "javascript:alert(1)", std::string("fine"),
                ResultCell(), 2.0, 0.6}},
              {{evil, ResultCell(), ResultCell(), ResultCell(), evil, evil, evil}}},
             evil, {{"options", {{"remark", evil}, {evil, evil}}}});
  EXPECT_EQ(html.find("<script>alert"), std::string::npos);
  EXPECT_EQ(html.find("<img src=x"), std::string::npos);
  EXPECT_EQ(html.find("<a href=\"./"), std::string::npos);
  EXPECT_EQ(html.find("<a href=\"javascript"), std::string::npos);
  EXPECT_EQ(plant_page::Rows(html), FileText(File("results.csv")));
  const json known = plant_page::Columns(html)["columns"];
  EXPECT_TRUE(std::any_of(known.begin(), known.end(),
                          [&](const json& column) { return column["name"] == head; }));
}

TEST_F(PlantPageTest, NoRowsOneRowAndColumnsThatNobodyKnows) {
  EXPECT_EQ(VerdictOf(PageOf(SyntheticPlantColumns(), {})), "No strings.");
  EXPECT_EQ(VerdictOf(SyntheticPage(1)), "1 of 1 string passes.");
  const std::string html = PageOf({Number("height_m")}, {{{3.0}}, {{4.0}}});
  EXPECT_EQ(VerdictOf(html), "2 of 2 strings have a result.");
  EXPECT_EQ(plant_page::Rows(html), "height_m\n3\n4\n");
}

TEST_F(PlantPageTest, TheVerdictCountsZonesCausesAndPower) {
  const std::vector<ResultColumn> columns = {Text("id"),          Text("status"),
                                             Text("zone"),        Text("cause"),
                                             Text("cause_title"), Number("recoverable_power_W")};
  const auto row = [](const char* status, const char* zone, const char* cause, const char* title,
                      double power) {
    return ResultRow{{std::string("s"), std::string(status), std::string(zone), std::string(cause),
                      std::string(title), power}};
  };
  const std::string html =
      PageOf(columns, {row("fine", "pass", "none", "", kNan), row("fine", "pass", "none", "", kNan),
                       row("fine", "pass within uncertainty", "soiling", "Uneven soiling", 90),
                       row("fine", "fail", "shade", "Partial shading", 1500),
                       row("fine", "fail", "shade", "Partial shading", 1700),
                       row("fine", "fail within uncertainty", "none", "", kNan),
                       row("broken", "", "", "", kNan)});
  EXPECT_EQ(
      VerdictOf(html),
      "3 of 7 strings pass. 3 need work: partial shading (2), no cause found (1). Repair would "
      "give about 3.2 kW. 1 of the strings that pass also shows a cause: uneven soiling (1). 1 "
      "could not be judged.");
}

TEST(ColumnInWords, HasNoUnitAndNoUnderscores) {
  EXPECT_EQ(ColumnInWords("performance_factor"), "performance factor");
  EXPECT_EQ(ColumnInWords("irradiance_Wm2"), "irradiance");
  EXPECT_EQ(ColumnInWords("Pmax_stc_W"), "Pmax at standard conditions");
  EXPECT_EQ(ColumnInWords("FF"), "FF");
  EXPECT_EQ(ColumnInWords("_W"), " W");
}

TEST_F(PlantPageTest, WithoutZonesAStringWithACauseNeedsWork) {
  const std::string html = PageOf(
      {Text("id"), Text("cause")},
      {{{std::string("a"), std::string("none")}}, {{std::string("b"), std::string("leaky_cell")}}});
  EXPECT_EQ(VerdictOf(html), "1 of 2 strings show no cause. 1 needs work: leaky_cell (1).");
}

// Wrong readings that were left out call for nothing more.
TEST_F(PlantPageTest, ACauseOfTheMeasurementIsNoWorkOnTheString) {
  const auto row = [](const char* cause, const char* about) {
    return ResultRow{{std::string("s"), std::string(cause), std::string(about)}};
  };
  const std::vector<ResultColumn> columns = {Text("id"), Text("cause"), Text("cause_about")};
  const std::string html =
      PageOf(columns, {row("", ""), row("leaky_cell", "device"), row("outliers", "instrument"),
                       row("irr_step", "sweep"), row("unknown_structure", "unknown")});
  EXPECT_EQ(
      VerdictOf(html),
      "2 of 5 strings show no cause. 2 need work: leaky_cell (1), unknown_structure (1). 1 must be "
      "measured again, because the measurement has a fault: irr_step (1).");
}

TEST_F(PlantPageTest, TheWorstComeFirstAndAreTheWorst) {
  std::vector<ResultRow> rows;
  for (int r = 0; r < 300; ++r) {
    const int shuffled = r * 7 % 300;
    rows.push_back({{"s" + std::to_string(1000 + shuffled), shuffled / 300.0}});
  }
  const std::string html = PageOf({Text("id"), Number("performance_factor")}, rows);
  std::size_t place = html.find("The 100 worst strings, by performance factor");
  ASSERT_NE(place, std::string::npos);
  for (int r = 0; r < 100; ++r) {
    const std::string id = "<th scope=\"row\">s" + std::to_string(1000 + r) + "</th>";
    place = html.find(id, place);
    ASSERT_NE(place, std::string::npos) << id;
  }
  EXPECT_EQ(html.find(">s1100<", place), std::string::npos);
}

TEST_F(PlantPageTest, AStringThatPassesIsNotAmongThoseToVisit) {
  const auto row = [](const char* id, const char* zone, double factor) {
    return ResultRow{{std::string(id), std::string(zone), factor}};
  };
  const std::string html = PageOf(
      {Text("id"), Text("zone"), Number("performance_factor")},
      {row("good", "pass", 1.02), row("bad", "fail", 0.8),
       row("near", "fail within uncertainty", 0.96), row("just", "pass within uncertainty", 1)});
  EXPECT_NE(html.find("The 2 worst strings, by what is lost"), std::string::npos);
  EXPECT_NE(html.find("<th scope=\"row\">bad</th>"), std::string::npos);
  EXPECT_NE(html.find("<th scope=\"row\">near</th>"), std::string::npos);
  EXPECT_EQ(html.find("<th scope=\"row\">good</th>"), std::string::npos);
  EXPECT_EQ(html.find("<th scope=\"row\">just</th>"), std::string::npos);
}

TEST_F(PlantPageTest, TheGroupsThatLoseMostComeFirst) {
  std::vector<ResultRow> rows;
  const auto add = [&](const char* id, const char* title, double power) {
    rows.push_back({{std::string(id), std::string("fail"), std::string(title), std::string(title),
                     power, 0.9}});
  };
  add("a/1/x", "shade", 100);
  add("a/2/x", "shade", 300);
  add("a/2/y", "leak", 50);
  rows.push_back({{std::string("b/1/x"), std::string("pass"), std::string("none"), std::string(),
                   ResultCell(), 1.01}});
  const std::string html = PageOf({Text("id"), Text("zone"), Text("cause"), Text("cause_title"),
                                   Number("recoverable_power_W"), Number("performance_factor")},
                                  rows);
  EXPECT_THAT(html, HasSubstr("<th scope=\"row\">a/2</th><td class=\"number\">350</td><td "
                              "class=\"number\">300</td><td class=\"number\">50</td>"));
  if (!PlotlyIsEmbedded()) GTEST_SKIP() << "this build has no Plotly";
  const json groups = plant_page::Chart(html, "figure-1");
  EXPECT_EQ(groups["layout"]["xaxis"]["ticktext"], json({"a/2", "a/1"}));
  // Bars stand one on the other, and say their own part.
  EXPECT_EQ(groups["data"][2]["y"], json({350.0}));
  EXPECT_EQ(groups["data"][2]["hovertext"], json({"a/2: leak, 50 W"}));
  EXPECT_EQ(groups["data"][3]["y"], json({300.0, 100.0}));
  const json map = plant_page::Chart(html, "figure-2");
  EXPECT_EQ(map["layout"]["yaxis"]["ticktext"], json({"a", "b"}));
  EXPECT_EQ(map["data"][0]["hovertext"][2],
            "b/1: 1 string, 0 need work, lowest performance factor 1.010");
}

TEST_F(PlantPageTest, DistributionsCountEveryString) {
  std::vector<ResultRow> rows;
  for (int r = 0; r < 1000; ++r) {
    rows.push_back({{"a/" + std::to_string(r), 0.9 + 0.0001 * r, r == 7 ? 50.0 : 0.01 * (r % 100),
                     r == 7, std::string(r == 7 ? "Pmax/G +50 %" : "")}});
  }
  const std::string html = PageOf({Text("id"),
                                   Number("performance_factor"),
                                   Number("group_deviation_percent"),
                                   {"group_flag", "", CellType::kTruth, ""},
                                   Text("group_outlier")},
                                  rows);
  EXPECT_THAT(html,
              HasSubstr("<th scope=\"row\">performance factor</th><td class=\"number\">1,000"));
  EXPECT_THAT(html, HasSubstr("<th scope=\"row\">a/7</th><td class=\"words\">Pmax/G +50 %</td>"));
  if (!PlotlyIsEmbedded()) GTEST_SKIP() << "this build has no Plotly";
  const auto counted = [](const json& trace) {
    double sum = 0;
    for (const json& count : trace["y"]) sum += count.get<double>();
    return sum;
  };
  const json neighbours = plant_page::Chart(html, "figure-3");
  std::vector<double> sums;
  for (const json& trace : neighbours["data"]) {
    if (trace["type"] == "bar") sums.push_back(counted(trace));
  }
  EXPECT_EQ(sums, (std::vector<double>{1000, 1}));
}

TEST_F(PlantPageTest, NumbersThatAreEqualToRoundingAreOneBar) {
  std::vector<ResultRow> rows(50, ResultRow{{0.7741935483870968}});
  rows.push_back({{std::nextafter(0.7741935483870968, 1)}});
  rows.push_back({{kNan}});
  const std::string html = PageOf({Number("FF")}, rows);
  EXPECT_THAT(html, HasSubstr("<th scope=\"row\">FF</th><td class=\"number\">51</td>"));
  EXPECT_THAT(html, HasSubstr("<svg "));
}

TEST_F(PlantPageTest, ItReadsWithoutScripts) {
  const std::string html = SyntheticPage(500);
  for (const char* text : {"Strings by zone", "Strings that need work, by cause", "<svg ",
                           "Why there is no result", "site1/inv01"}) {
    EXPECT_LT(html.find(text), html.find("id=\"rows\"")) << text;
  }
}

TEST_F(PlantPageTest, NothingIsFetched) {
  std::string html = SyntheticPage(50);
  // Code by others may name addresses; it is packed, and nothing may be fetched anyway.
  for (const char* text : {" src=", "@import", "fetch(", "XMLHttpRequest", "href=\"http"}) {
    EXPECT_EQ(html.find(text), std::string::npos) << text;
  }
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
}

TEST_F(PlantPageTest, OnlyTheRowsGrow) {
  const auto around = [this](int strings) {
    std::vector<ResultRow> rows;
    for (int r = 0; r < strings; ++r) {
      rows.push_back({{fmt::format("inv{}/comb{}/str{}", r / 200, r / 20 % 10, r % 20), 0.9}});
    }
    const std::string html = PageOf({Text("id"), Number("performance_factor")}, rows);
    std::size_t place = 0;
    return static_cast<double>(
        html.size() - plant_page::Between(html, "id=\"rows\">", "</script>", &place).size());
  };
  // 400 and 2,000 nodes: the limit of drawn nodes and the limit of counted nodes.
  EXPECT_LT(around(40000), 1.1 * around(8000));
}

TEST_F(PlantPageTest, TenThousandStringsTakeLessThanFourMegabytes) {
  EXPECT_LT(SyntheticPage(10000).size(), 4'000'000u);
}

TEST_F(PlantPageTest, AnErrorLeavesThePageThatIsThere) {
  const std::string before = SyntheticPage(3);
  EXPECT_EQ(FilesThere(), 4u);
  const auto refused = [&](const std::string& broken, const std::string& text) {
    std::ofstream(File(broken)) << text;
    const auto rows = WritePlantPage(folder_.Path(""), File("page.html"), "Plant");
    EXPECT_FALSE(rows) << broken;
    EXPECT_EQ(FileText(File("page.html")), before);
    return rows ? Error() : rows.error();
  };
  const Error line = refused("results.jsonl", "{\"id\":\"a\"}\n{\"id\":\n");
  EXPECT_EQ(line.line, 2);
  EXPECT_THAT(refused("results.schema.json", "[]").message, HasSubstr("schema"));
  std::filesystem::remove(File("results.schema.json"));
  EXPECT_FALSE(WritePlantPage(folder_.Path(""), File("page.html"), "Plant"));
  EXPECT_EQ(FilesThere(), 3u);
}

TEST_F(PlantPageTest, FoldersThatAreNotThereAreErrors) {
  SyntheticPage(3);
  EXPECT_FALSE(WritePlantPage(File("none"), File("page.html"), "Plant"));
  EXPECT_FALSE(WritePlantPage(folder_.Path(""), File("no/such/page.html"), "Plant"));
  EXPECT_FALSE(WritePlantPage(folder_.Path(""), folder_.Path(""), "Plant"));
}

}  // namespace
}  // namespace lyrefit
