#include "lyrefit/batch/plant_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "batch/read_plant_page.h"
#include "batch/synthetic_rows.h"
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
                     const PlantPageOptions& options = {}) const {
    const std::string file = File("page.html");
    auto page = PlantPage::Open(file, columns, options);
    EXPECT_TRUE(page) << (page ? "" : page.error().ToString());
    for (const ResultRow& row : rows) EXPECT_TRUE((*page)->Add(row));
    EXPECT_TRUE((*page)->Finish());
    return FileText(file);
  }

  std::string SyntheticPage(std::int64_t rows, int digits = 0) const {
    std::vector<ResultRow> made;
    for (std::int64_t row = 0; row < rows; ++row) made.push_back(SyntheticPlantResult(1, row));
    PlantPageOptions options;
    options.digits = digits;
    return PageOf(SyntheticPlantColumns(), made, options);
  }

  std::size_t FilesThere() const {
    return std::distance(std::filesystem::directory_iterator(folder_.Path("")), {});
  }

  TempFolder folder_;
};

std::string VerdictOf(const std::string& html) {
  std::size_t place = 0;
  return plant_page::Between(html, "<div class=\"verdict\"><p>", "</p>", &place);
}

ResultColumn Number(const std::string& name) { return {name, "", CellType::kNumber, ""}; }
ResultColumn Text(const std::string& name) { return {name, "", CellType::kText, ""}; }

json JsonOf(const ResultCell& cell) {
  return std::visit(
      [](const auto& value) -> json {
        using T = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<T, std::monostate>) {
          return nullptr;
        } else if constexpr (std::is_same_v<T, std::string>) {
          return value;
        } else {
          return static_cast<double>(value);
        }
      },
      cell);
}

TEST_F(PlantPageTest, TheTableUnpacksToExactlyTheRowsOverSeveralGroups) {
  constexpr std::int64_t kRows = 9000;
  const auto columns = plant_page::Columns(SyntheticPage(kRows));
  ASSERT_EQ(columns.size(), SyntheticPlantColumns().size());
  for (std::int64_t row = 0; row < kRows; ++row) {
    const ResultRow made = SyntheticPlantResult(1, row);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      ASSERT_EQ(columns[c].at(row), JsonOf(made.cells[c])) << row << " " << c;
    }
  }
}

TEST_F(PlantPageTest, NumbersKeepTheirBits) {
  const std::vector<double> numbers = {
      0.1, 1.0 / 3, 1e-300, 5e-324, 1.7976931348623157e308, -2.5e7, 1e22, 123456789012345678.0};
  std::vector<ResultRow> rows;
  for (const double number : numbers) rows.push_back({{number}});
  const auto columns = plant_page::Columns(PageOf({Number("x")}, rows));
  for (std::size_t r = 0; r < numbers.size(); ++r) {
    EXPECT_EQ(columns[0][r].get<double>(), numbers[r]);
  }
}

TEST_F(PlantPageTest, DecimalsOfAnySizeAndSignKeepTheirBits) {
  std::vector<ResultRow> rows;
  for (int k = -70000; k < 70000; k += 977) rows.push_back({{k / 1000.0}});
  const auto columns = plant_page::Columns(PageOf({Number("x")}, rows));
  for (std::size_t r = 0; r < rows.size(); ++r) {
    ASSERT_EQ(columns[0][r].get<double>(), std::get<double>(rows[r].cells[0]));
  }
}

TEST_F(PlantPageTest, WhatIsNotKnownIsNullAndInfinityStays) {
  const double infinity = std::numeric_limits<double>::infinity();
  const auto columns = plant_page::Columns(PageOf(
      {Number("x"), Text("t"), {"w", "", CellType::kWhole, ""}, {"b", "", CellType::kTruth, ""}},
      {{{kNan, ResultCell(), ResultCell(), ResultCell()}},
       {{infinity, std::string(), std::int64_t{-7}, false}},
       {{}}}));
  EXPECT_EQ(columns[0], (plant_page::Cells{nullptr, infinity, nullptr}));
  EXPECT_EQ(columns[1], (plant_page::Cells{nullptr, "", nullptr}));
  EXPECT_EQ(columns[2], (plant_page::Cells{nullptr, -7, nullptr}));
  EXPECT_EQ(columns[3], (plant_page::Cells{nullptr, 0, nullptr}));
}

TEST_F(PlantPageTest, DigitsRoundNumbersAndShrinkThePage) {
  const auto columns = plant_page::Columns(
      PageOf({Number("x")}, {{{1.23456789}}, {{9.87654321e-12}}, {{kNan}}}, {"Plant", {}, 3}));
  EXPECT_EQ(columns[0], (plant_page::Cells{1.23, 9.88e-12, nullptr}));
  EXPECT_LT(SyntheticPage(2000, 6).size(), SyntheticPage(2000).size());
}

TEST_F(PlantPageTest, HostileNamesAreTextAndNothingElse) {
  const std::string evil = "a\"b'</script><script>alert(1)</script><!--rows--><img src=x>";
  PlantPageOptions options;
  options.plant = evil;
  options.facts = {{evil, evil}};
  const std::vector<ResultColumn> columns = {
      Text("id"),     Text("zone"),   Text("cause"), Text("cause_title"),
      Text("status"), Text("reason"), Number(evil),  Number("performance_factor")};
  const std::string html = PageOf(
      columns,
      {{{evil + "/x", evil, evil, evil, std::string("fine"), ResultCell(), 1.0, 0.5}},
       {{evil, ResultCell(), ResultCell(), ResultCell(), evil, evil, ResultCell(), ResultCell()}}},
      options);
  EXPECT_EQ(html.find("<script>alert"), std::string::npos);
  EXPECT_EQ(html.find("<img src=x"), std::string::npos);
  EXPECT_EQ(html.substr(0, html.find("class=\"rows\"")).find("\"b'"), std::string::npos);
  const auto read = plant_page::Columns(html);
  EXPECT_EQ(read[0], (plant_page::Cells{evil + "/x", evil}));
  EXPECT_EQ(plant_page::Index(html)["columns"][6]["name"], evil);
}

TEST_F(PlantPageTest, TextsOfAnyTongueComeBackAndBrokenOnesAreReplaced) {
  const std::string solar = "\xe5\xa4\xaa\xe9\x99\xbd/\xc3\x9c\x62\x65r/\xf0\x9f\x8c\x9e";
  const std::string html =
      PageOf({Text("id")}, {{{solar}}, {{std::string("a\xff/b")}}, {{std::string("nul\0l", 5)}}});
  EXPECT_EQ(plant_page::Columns(html)[0],
            (plant_page::Cells{solar, "a\xef\xbf\xbd/b", std::string("nul\0l", 5)}));
}

TEST_F(PlantPageTest, NoRowsOneRowAndColumnsThatNobodyKnows) {
  EXPECT_EQ(VerdictOf(PageOf(SyntheticPlantColumns(), {})), "No strings.");
  EXPECT_EQ(VerdictOf(SyntheticPage(1)), "1 of 1 string passes.");
  const std::string html = PageOf({Number("height_m")}, {{{3.0}}, {{4.0}}});
  EXPECT_EQ(VerdictOf(html), "2 of 2 strings have a result.");
  EXPECT_EQ(plant_page::Columns(html)[0], (plant_page::Cells{3.0, 4.0}));
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
      "3 of 7 strings pass; 3 need work: partial shading (2), no cause found (1), worth about "
      "3.2 kW. Of those that pass, 1 shows a cause all the same: uneven soiling (1). 1 could "
      "not be judged.");
}

TEST_F(PlantPageTest, WithoutZonesAStringWithACauseNeedsWork) {
  const std::string html = PageOf(
      {Text("id"), Text("cause")},
      {{{std::string("a"), std::string("none")}}, {{std::string("b"), std::string("leaky_cell")}}});
  EXPECT_EQ(VerdictOf(html), "1 of 2 strings show no cause; 1 needs work: leaky_cell (1).");
}

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
      "1 of 5 strings show no cause; 2 need work: leaky_cell (1), unknown_structure (1). 2 have to "
      "be measured again, for a cause of the measurement alone: irr_step (1), outliers (1).");
}

TEST_F(PlantPageTest, TheWorstComeFirstAndAreTheWorst) {
  std::vector<ResultRow> rows;
  for (int r = 0; r < 300; ++r) {
    const int shuffled = r * 7 % 300;
    rows.push_back({{"s" + std::to_string(1000 + shuffled), shuffled / 300.0}});
  }
  const std::string html = PageOf({Text("id"), Number("performance_factor")}, rows);
  std::size_t place = html.find("The 25 worst strings, by performance_factor");
  ASSERT_NE(place, std::string::npos);
  for (int r = 0; r < 25; ++r) {
    const std::string id = "<th scope=\"row\">s" + std::to_string(1000 + r) + "</th>";
    place = html.find(id, place);
    ASSERT_NE(place, std::string::npos) << id;
  }
  EXPECT_EQ(html.find(">s1025<", place), std::string::npos);
}

TEST_F(PlantPageTest, ItReadsWithoutScripts) {
  const std::string html = SyntheticPage(500);
  for (const char* text : {"Strings by zone", "Causes of those that need work", "<svg viewBox",
                           "Why there is no result", "site1/inv01"}) {
    EXPECT_LT(html.find(text), html.find("class=\"rows\"")) << text;
  }
}

TEST_F(PlantPageTest, NothingIsFetched) {
  const std::string html = SyntheticPage(50);
  for (const char* text : {" src=", "url(", "@import", "fetch(", "XMLHttpRequest", "href=\"http"}) {
    EXPECT_EQ(html.find(text), std::string::npos) << text;
  }
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
}

TEST_F(PlantPageTest, OnlyTheCompressedTableGrows) {
  const auto around = [this](int strings) {
    std::vector<ResultRow> rows;
    for (int r = 0; r < strings; ++r) {
      rows.push_back({{fmt::format("inv{}/comb{}/str{}", r / 200, r / 20 % 10, r % 20), 0.9}});
    }
    const std::string html = PageOf({Text("id"), Number("performance_factor")}, rows);
    std::size_t inside = 0;
    const json index = plant_page::Index(html);
    for (const json& group : index["groups"]) {
      for (const std::size_t part : group["parts"]) inside += part;
    }
    return static_cast<double>(html.size() - inside);
  };
  // 400 and 2,000 nodes: the limit of drawn nodes and the limit of counted nodes.
  EXPECT_LT(around(40000), 1.1 * around(8000));
}

TEST_F(PlantPageTest, TenThousandStringsTakeLessThanTwoMegabytes) {
  EXPECT_LT(SyntheticPage(10000).size(), 2'000'000u);
}

TEST_F(PlantPageTest, ThePageIsThereWhenItIsFinishedAndNothingElseIsLeft) {
  const std::string file = File("page.html");
  {
    auto page = PlantPage::Open(file, SyntheticPlantColumns());
    ASSERT_TRUE(page);
    ASSERT_TRUE((*page)->Add(SyntheticPlantResult(1, 0)));
    EXPECT_EQ(FilesThere(), 0u);
  }
  EXPECT_EQ(FilesThere(), 0u);
  SyntheticPage(3);
  EXPECT_EQ(FilesThere(), 1u);
}

TEST_F(PlantPageTest, FoldersThatAreNotThereAndNoColumnsAreErrors) {
  EXPECT_THAT(PlantPage::Open(File("no/such/page.html"), SyntheticPlantColumns()).error().message,
              HasSubstr("cannot write the page"));
  EXPECT_THAT(PlantPage::Open(folder_.Path(""), SyntheticPlantColumns()).error().message,
              HasSubstr("found a folder"));
  EXPECT_FALSE(PlantPage::Open(File("page.html"), {}));
}

TEST_F(PlantPageTest, RowsThatWereWrittenBeforeMakeTheirPage) {
  const std::string results = File("results.jsonl");
  std::ofstream(results) << "{\"id\":\"a/b\",\"n\":1,\"x\":null,\"ok\":true,\"outlier\":1}\n\n"
                            "{\"id\":\"a/c\",\"n\":2,\"x\":0.5,\"ok\":false,\"outlier\":\"two\"}\n"
                            "{\"id\":\"a/d\",\"late\":\"here\"}\n";
  const auto rows =
      WritePlantPage(results, File("page.html"), {}, {{"x", "ohm", CellType::kNumber, "of x"}});
  ASSERT_TRUE(rows) << rows.error().ToString();
  EXPECT_EQ(*rows, 3);
  const std::string html = FileText(File("page.html"));
  const json index = plant_page::Index(html);
  EXPECT_EQ(index["columns"][2],
            (json{{"name", "x"}, {"unit", "ohm"}, {"type", "number"}, {"doc", "of x"}}));
  const auto columns = plant_page::Columns(html);
  EXPECT_EQ(columns[0], (plant_page::Cells{"a/b", "a/c", "a/d"}));
  EXPECT_EQ(columns[1], (plant_page::Cells{1, 2, nullptr}));
  EXPECT_EQ(columns[2], (plant_page::Cells{nullptr, 0.5, nullptr}));
  EXPECT_EQ(columns[3], (plant_page::Cells{1, 0, nullptr}));
  EXPECT_EQ(columns[4], (plant_page::Cells{"1", "two", nullptr}));
  EXPECT_EQ(columns[5], (plant_page::Cells{nullptr, nullptr, "here"}));
}

TEST_F(PlantPageTest, ALineThatIsNoRowIsAnErrorWithItsPlace) {
  const std::string results = File("results.jsonl");
  std::ofstream(results) << "{\"id\":\"a\"}\n{\"id\":\n";
  const auto rows = WritePlantPage(results, File("page.html"));
  ASSERT_FALSE(rows);
  EXPECT_EQ(rows.error().line, 2);
  EXPECT_FALSE(WritePlantPage(File("none.jsonl"), File("page.html")));
  EXPECT_EQ(FilesThere(), 1u);
}

}  // namespace
}  // namespace lyrefit
