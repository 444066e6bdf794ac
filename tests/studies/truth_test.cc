#include "studies/truth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/search/search.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr char kTruthHeader[] =
    "Index,photocurrent,saturation_current,resistance_series,resistance_shunt,n,cells_in_series\n";

std::string ErrorOf(const std::string& rows) {
  const TempFolder folder;
  const auto truth = ReadTruth(folder.Write("t.csv", kTruthHeader + rows));
  return truth ? "" : truth.error().ToString();
}

TEST(ReadTruth, BringsTheColumnsIntoTheDevicesOrder) {
  const TempFolder folder;
  const auto truth = ReadTruth(folder.Write(
      "t.csv",
      std::string(kTruthHeader) + "1,8,5e-10,0.1,3000,1.01,72\r\n2,1,5E-10,0,300,1.3,36\r\n"));
  ASSERT_TRUE(truth) << truth.error().ToString();
  ASSERT_THAT(*truth, SizeIs(2));
  EXPECT_EQ((*truth)[0].index, "1");
  EXPECT_EQ((*truth)[0].values, (std::vector<double>{8, 5e-10, 1.01, 0.1, 3000}));
  EXPECT_EQ((*truth)[1].cells_in_series, 36);
}

TEST(ReadTruth, NamesFileLineAndColumnOfWhatItRefuses) {
  EXPECT_THAT(ErrorOf("1,8,5e-10,0.1,3000,1.01,72\n2,8,much,0.1,3000,1.01,72\n"),
              HasSubstr("t.csv:3:5: expected a number above 0, found 'much'"));
  EXPECT_THAT(ErrorOf("1,8,5e-10,-0.1,3000,1.01,72\n"),
              HasSubstr("t.csv:2:11: expected a number from 0"));
  EXPECT_THAT(ErrorOf("1,8,5e-10,0.1,3000,1.01,7.5\n"),
              HasSubstr("a whole number from 1 to 10000"));
  EXPECT_THAT(ErrorOf("1,8,5e-10,0.1,3000,1.01,72\n1,8,5e-10,0.1,3000,1.01,72\n"),
              HasSubstr("t.csv:3:1: expected an index that did not occur yet, found '1'"));
  EXPECT_THAT(ErrorOf("1,8,5e-10,0.1\n"), HasSubstr("expected at least 7 fields, found 4"));
  EXPECT_THAT(ErrorOf(""), HasSubstr("expected at least one row"));
}

FamilyCurve Fitted(const std::string& id, const std::vector<double>& parameters) {
  FamilyCurve curve;
  curve.id = id;
  curve.individual_parameters = parameters;
  return curve;
}

FamilyReport ThreeFits() {
  FamilyReport report;
  report.cells_in_series = 72;
  report.curves = {Fitted("1", {8.08, 5e-10, 1.0, 0.1, 2000}),
                   Fitted("2", {7.84, 5e-10, 1.0, 0.1, kInfinity}),
                   Fitted("3", {8.00, 6e-10, 1.1, 0.1, 1000})};
  return report;
}

const TruthRow kOne{"1", {8, 5e-10, 1.0, 0.1, 2000}, 72};

TEST(CompareWithTruth, SaysWorstAndMedianOfOneDeviceForAllCurves) {
  const TruthComparison all = CompareWithTruth(ThreeFits(), {kOne});
  EXPECT_TRUE(all.one_truth);
  EXPECT_EQ(all.curves, 3);
  ASSERT_THAT(all.parameters, SizeIs(5));
  EXPECT_EQ(all.parameters[0].info.symbol, "Iph");
  EXPECT_NEAR(all.parameters[0].worst, 0.02, 1e-12);
  EXPECT_EQ(all.parameters[0].worst_id, "2");
  EXPECT_NEAR(all.parameters[0].median, 0.01, 1e-12);
  EXPECT_EQ(all.parameters[4].info.symbol, "Rsh");
  EXPECT_NEAR(all.parameters[4].median, 0.5, 1e-12);
}

TEST(CompareWithTruth, AveragesTheShuntAsAConductance) {
  const TruthComparison all = CompareWithTruth(ThreeFits(), {kOne});
  const TruthParameter& shunt = all.parameters[4];
  EXPECT_EQ(shunt.truth, 2000);
  // Conductances of 0.5, 0 and 1 mS, whose mean is the true 0.5 mS (2000 ohm).
  EXPECT_NEAR(shunt.mean, 2000, 1e-9);
  EXPECT_NEAR(shunt.mean_error, 0, 1e-12);
  EXPECT_NEAR(shunt.root_mean_square, std::sqrt(2.0 / 3), 1e-12);
  EXPECT_NEAR(all.parameters[0].mean_error, (8.08 + 7.84 + 8.00) / 24 - 1, 1e-12);
  EXPECT_NEAR(all.parameters[0].root_mean_square, std::sqrt((1e-4 + 4e-4) / 3), 1e-12);
}

TEST(CompareWithTruth, GoesByTheIndexWhereThereAreManyTruths) {
  TruthRow second = kOne;
  second.index = "2";
  second.values[0] = 7.84;
  const TruthComparison some = CompareWithTruth(ThreeFits(), {kOne, second});
  EXPECT_FALSE(some.one_truth);
  EXPECT_EQ(some.curves, 2);
  EXPECT_EQ(some.unmatched, 1);
  EXPECT_NEAR(some.parameters[0].worst, 0.01, 1e-12);
  EXPECT_TRUE(std::isnan(some.parameters[0].mean_error));
}

TEST(CompareWithTruth, CountsTheIntervalsThatHoldTheTruth) {
  FamilyReport report = ThreeFits();
  for (FamilyCurve& curve : report.curves) {
    curve.individual_estimates.resize(5);
    const double value = curve.individual_parameters[0];
    curve.individual_estimates[0].low_95 = value - 0.1;
    curve.individual_estimates[0].high_95 = value + 0.1;
  }
  report.curves[2].individual_estimates[0].low_95 = kUnknown;
  const TruthComparison all = CompareWithTruth(report, {kOne});
  EXPECT_EQ(all.parameters[0].intervals, 2);
  EXPECT_EQ(all.parameters[0].covered, 1);
  EXPECT_EQ(all.parameters[1].intervals, 0);
}

TEST(CompareWithTruth, WarnsWhereThereIsNothingToCompare) {
  FamilyReport report = ThreeFits();
  for (FamilyCurve& curve : report.curves) curve.individual_parameters.resize(7, 1);
  EXPECT_THAT(CompareWithTruth(report, {kOne}).warnings.at(0), HasSubstr("of one diode"));
  for (FamilyCurve& curve : report.curves) curve.individual_parameters.clear();
  EXPECT_THAT(CompareWithTruth(report, {kOne}).warnings.at(0), HasSubstr("no curve"));
  report = ThreeFits();
  report.cells_in_series = 60;
  EXPECT_THAT(CompareWithTruth(report, {kOne}).warnings.at(0), HasSubstr("cells in series"));
}

}  // namespace
}  // namespace lyrefit
