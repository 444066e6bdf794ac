#include "lyrefit/study/report/documents.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "lyrefit/report/text_layout.h"
#include "lyrefit/study/coverage.h"
#include "lyrefit/study/report/coverage_json.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

ParameterCoverage Parameter(const std::string& symbol, int covered, double low, double high) {
  ParameterCoverage p;
  p.info.symbol = p.info.name = symbol;
  p.fitted = 100;
  p.counted = 90;
  p.not_identifiable = 10;
  p.covered = covered;
  p.coverage = covered / 90.0;
  p.low_95 = low;
  p.high_95 = high;
  p.median_half_width = 0.0123;
  return p;
}

CoverageReport Sample() {
  CoverageReport report;
  report.version = "1.2.3";
  report.options.family.temperature_offset = true;
  report.options.temperature_error_K = 2;
  report.parameters = {Parameter("Iph", 86, 0.89, 0.98), Parameter("Rs", 60, 0.56, 0.75)};
  ParameterCoverage held;
  held.info.symbol = held.info.name = "dEg";
  report.parameters.push_back(held);
  report.parameters.push_back(Parameter("dT", 90, 0.959, 1));
  report.parameters.back().offset = true;
  CoverageSet set;
  set.rows.assign(4, {});
  set.rows[0].truth = 8;
  report.sets = {set, {}};
  report.sets[1].error = "nothing to fit";
  report.failed = 1;
  return report;
}

// The row of the table that begins with `symbol`.
std::string Row(const std::string& text, const std::string& symbol) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("  " + symbol + " ", 0) == 0) return line;
  }
  return "";
}

TEST(CoverageText, SaysWhetherTheIntervalsKeepTheirPromise) {
  const std::string text = CoverageText(Sample());
  EXPECT_THAT(Row(text, "Iph"), HasSubstr("95.6 %"));
  EXPECT_THAT(Row(text, "Iph"), HasSubstr("89.0 % .. 98.0 %"));
  EXPECT_THAT(Row(text, "Iph"), HasSubstr("1.23 %"));
  EXPECT_THAT(Row(text, "Iph"), HasSubstr("10.0 %"));
  EXPECT_THAT(Row(text, "Iph"), HasSubstr("as promised"));
  EXPECT_THAT(Row(text, "Rs"), HasSubstr("too narrow"));
  EXPECT_THAT(Row(text, "dEg"), HasSubstr("held"));
  EXPECT_THAT(Row(text, "dT"), HasSubstr("too wide"));
  EXPECT_THAT(Row(text, "dT"), HasSubstr("0.012")) << "in kelvin, not in percent";
  EXPECT_THAT(Row(text, "dT"), Not(HasSubstr("1.23 %")));
}

TEST(CoverageText, NamesSensorErrorsAndFailedSetsAndFitsTheTerminal) {
  const std::string text = CoverageText(Sample());
  EXPECT_THAT(text, HasSubstr("temperature reads +2 K, offset fitted"));
  EXPECT_THAT(text, HasSubstr("irradiance reads +0 W/m2, offset not fitted"));
  EXPECT_THAT(text, HasSubstr("1 set without a usable fit"));
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), static_cast<std::size_t>(kTextWidth)) << line;
  }
}

TEST(CoverageJson, HoldsCountsAndEverySet) {
  const auto json = nlohmann::json::parse(CoverageJson(Sample()));
  EXPECT_EQ(json["options"]["temperature_error_K"], 2);
  EXPECT_EQ(json["parameters"][0]["covered"], 86);
  EXPECT_TRUE(json["parameters"][2]["coverage"].is_null());
  EXPECT_EQ(json["sets"][0]["parameters"]["Iph"]["truth"], 8);
  EXPECT_EQ(json["sets"][1]["error"], "nothing to fit");
}

}  // namespace
}  // namespace lyrefit
