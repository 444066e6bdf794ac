#include "lyrefit/report/fits_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "lyrefit/report/documents.h"
#include "sample_report.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    lines.push_back(text.substr(begin, end - begin));
  }
  return lines;
}

std::vector<FittedFile> Sample() {
  FitReport warned = SampleReport();
  warned.warnings = {"first, of two", "second"};
  warned.usable = false;
  FitReport searched = SampleReport();
  searched.polished = false;
  return {{"a.csv", warned},
          {"b, c.csv", Fail("expected a number, found 'x'", "b, c.csv", 2, 3)},
          {"d.csv", searched}};
}

TEST(FitsCsv, HasARowAFileInTheirOrder) {
  const auto lines = Lines(FitsCsv(Sample()));
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0],
            "file,name,model,objective,cells_in_series,temperature_C,irradiance_Wm2,points,"
            "Iph_A,Iph_A_se,Is1_A,Is1_A_se,n1,n1_se,Rs_ohm,Rs_ohm_se,Rsh_ohm,Rsh_ohm_se,"
            "rmse_searched_measured_current_A,rmse_searched_solved_current_A,"
            "rmse_refined_measured_current_A,rmse_refined_solved_current_A,usable,warnings,error");
  EXPECT_THAT(lines[1], StartsWith("a.csv,sample_cell,sd,solved-current,1,33,1000,26,"
                                   "0.76078796653915,"));
  EXPECT_THAT(lines[1], EndsWith("0.0009871,0.000776,0.00098912345678,0.00077300626899,false,"
                                 "\"first, of two; second\","));
  EXPECT_THAT(lines[2], StartsWith("\"b, c.csv\",,,,"));
  EXPECT_THAT(lines[2], EndsWith(",\"b, c.csv:2:3: expected a number, found 'x'\""));
  EXPECT_THAT(lines[3], HasSubstr(",26,0.7608,"));
  EXPECT_THAT(lines[3], HasSubstr(",0.0009871,0.000776,,,true,"));
}

TEST(FitsCsv, HasTheParametersOfTheLargestModel) {
  FitReport larger = SampleReport();
  larger.model = Model::kDoubleDiode;
  larger.device = MakeDevice(larger.model, larger.curve.conditions);
  larger.estimates.clear();
  for (const ParameterInfo& info : larger.device.parameters) {
    Estimate estimate;
    estimate.info = info;
    estimate.refined = 2;
    larger.estimates.push_back(estimate);
  }
  const auto lines = Lines(FitsCsv({{"a.csv", SampleReport()}, {"b.csv", larger}}));
  EXPECT_THAT(lines[0], HasSubstr(",Is2_A,Is2_A_se,n2,n2_se"));
  for (std::size_t i = 1; i < lines.size(); ++i) {
    EXPECT_EQ(std::count(lines[i].begin(), lines[i].end(), ','),
              std::count(lines[0].begin(), lines[0].end(), ','));
  }
}

TEST(FitsCsv, OfBrokenFilesAloneIsATableToo) {
  const auto lines = Lines(FitsCsv({{"a.csv", Fail("empty")}}));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(std::count(lines[1].begin(), lines[1].end(), ','),
            std::count(lines[0].begin(), lines[0].end(), ','));
}

TEST(FitsDocument, HasARowAFitAndSaysWhyOthersHaveNone) {
  const auto lines = Lines(DrawText(FitsDocument(Sample())));
  ASSERT_EQ(lines.size(), 14U);
  EXPECT_THAT(lines[0], EndsWith(": fits of 3 curves"));
  EXPECT_EQ(lines[2], "Parameters");
  EXPECT_THAT(lines[3], HasSubstr("Iph"));
  EXPECT_THAT(lines[5], StartsWith("  a.csv  sd         26         9.891e-04       7.730e-04"));
  EXPECT_THAT(lines[5], EndsWith("0.036547  52.890  NOT USABLE"));
  EXPECT_THAT(lines[6], EndsWith("0.036300  53.700  not polished"));
  EXPECT_EQ(lines[8], "Not fitted");
  EXPECT_EQ(lines[9], "  - b, c.csv: b, c.csv:2:3: expected a number, found 'x'");
  EXPECT_EQ(lines[11], "Warnings");
  EXPECT_EQ(lines[13], "  - a.csv: second");
}

TEST(FitsDocument, OfBrokenFilesAloneHasNoTable) {
  const Document document = FitsDocument({{"a.csv", Fail("empty")}});
  ASSERT_EQ(document.sections.size(), 1U);
  EXPECT_EQ(document.sections[0].heading, "Not fitted");
}

TEST(FitsJson, HoldsEveryReportUnderItsFile) {
  const json list = json::parse(FitsJson(Sample()));
  ASSERT_EQ(list.size(), 3U);
  EXPECT_EQ(list[0]["file"], "a.csv");
  json report = list[0];
  report.erase("file");
  EXPECT_EQ(report, json::parse(JsonReport(*Sample()[0].report)));
  EXPECT_EQ(list[1]["file"], "b, c.csv");
  EXPECT_EQ(list[1]["error"], "b, c.csv:2:3: expected a number, found 'x'");
  EXPECT_EQ(list[1].size(), 2U);
}

}  // namespace
}  // namespace lyrefit
