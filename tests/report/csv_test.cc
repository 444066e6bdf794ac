#include "lyrefit/report/csv.h"
#include "lyrefit/certify/certificate_documents.h"
#include "lyrefit/devices/device_documents.h"
#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/family/family_documents.h"
#include "lyrefit/read/spreadsheet_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "certify/sample_certificate.h"
#include "devices/sample_data_sheet.h"
#include "diagnose/sample_reference.h"
#include "family/sample_family.h"
#include "golden.h"
#include "sample_fits.h"

namespace lyrefit {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(CsvField, PutsAnApostropheBeforeWhatASpreadsheetWouldRun) {
  for (const char* text :
       {"=1+1", "+1+1", "-1-1", "@SUM(1)", "=cmd|' /C calc'!A0", "\t=1", " =1", "\tx", "\r1", "--1",
        "-x", "'=1", "''=1", "-1e", "-.", "-1.2.3", "-inf", "+nan",
        "\xef\xbc\x9d"
        "1"}) {
    const std::string field = CsvField(std::string(text));
    const std::string bare = field.front() == '"' ? field.substr(1, field.size() - 2) : field;
    EXPECT_EQ(bare, std::string("'") + text);
    EXPECT_EQ(WithoutApostrophe(bare), text);
  }
  EXPECT_EQ(CsvField(std::string("=a,b")), "\"'=a,b\"");
  EXPECT_EQ(CsvField(std::string("=1"), CsvTexts::kRaw), "=1");
}

TEST(CsvField, LeavesEverythingElse) {
  for (const char* text : {"", "str 1", "-0.5", "+49", "-1e-5", "-.5", "-5.", " -3 ", "1-1", "a=b",
                           "-", "+", "it's", "'quoted'", "'-0.5", "5 %"}) {
    EXPECT_EQ(CsvField(std::string(text)), text);
    EXPECT_EQ(WithoutApostrophe(text), text);
  }
  EXPECT_EQ(CsvField(-0.5), "-0.5");
  EXPECT_EQ(CsvField(std::string("a\xff")), "a\xef\xbf\xbd");
}

TEST(FitsCsv, HasARowAFileInTheirOrder) {
  const auto lines = LinesOf(FitsCsv(SampleFits()));
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
  const auto lines = LinesOf(FitsCsv({{"a.csv", SampleReport()}, {"b.csv", larger}}));
  EXPECT_THAT(lines[0], HasSubstr(",Is2_A,Is2_A_se,n2,n2_se"));
  for (std::size_t i = 1; i < lines.size(); ++i) {
    EXPECT_EQ(std::count(lines[i].begin(), lines[i].end(), ','),
              std::count(lines[0].begin(), lines[0].end(), ','));
  }
}

TEST(FitsCsv, OfBrokenFilesAloneIsATableToo) {
  const auto lines = LinesOf(FitsCsv({{"a.csv", Fail("empty")}}));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(std::count(lines[1].begin(), lines[1].end(), ','),
            std::count(lines[0].begin(), lines[0].end(), ','));
}

FamilyReport TwoCurves() {
  FamilyReport report;
  report.cells_in_series = 60;
  report.curves.resize(2);
  report.curves[0].id = "1";
  report.curves[0].parameters = {1, 2, 3, 4, 5};
  report.curves[0].individual_parameters = {6.1, 1.25e-10, 1.1, 0.3, 400};
  report.curves[1].id = "2,b";
  report.curves[1].parameters = {6, 1e-9, 1, 0.25, 500};
  return report;
}

TEST(IndividualFitsCsv, HasTheColumnsOfThePublishedParameterSets) {
  EXPECT_EQ(IndividualFitsCsv(TwoCurves()),
            "Index,photocurrent,saturation_current,resistance_series,resistance_shunt,n,"
            "cells_in_series\n"
            "1,6.1,1.25e-10,0.3,400,1.1,60\n"
            "\"2,b\",6,1e-09,0.25,500,1,60\n");
}

TEST(IndividualFitsCsv, AddsTheSecondDiode) {
  FamilyReport report = TwoCurves();
  report.translation.spec.model = Model::kDoubleDiode;
  report.curves[0].individual_parameters.insert(report.curves[0].individual_parameters.end(),
                                                {1e-7, 2});
  const std::string csv = IndividualFitsCsv(report);
  EXPECT_THAT(csv, HasSubstr(",cells_in_series,saturation_current_2,n_2\n"));
  EXPECT_THAT(csv, HasSubstr("\n1,6.1,1.25e-10,0.3,400,1.1,60,1e-07,2\n"));
}

TEST(IndividualFitsCsv, KeepsTheRowOfACurveWithoutParameters) {
  FamilyReport report = TwoCurves();
  report.curves[0].parameters.clear();
  report.curves[0].individual_parameters.clear();
  EXPECT_THAT(IndividualFitsCsv(report), HasSubstr("\n1,,,,,,60\n"));
}

// Every row has as many fields as the header; fields of these samples hold no comma.
void ExpectRectangular(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','),
              std::count(lines[0].begin(), lines[0].end(), ','))
        << line;
  }
}

TEST(CausesCsv, HasARowACauseAndOneOfAMeasurementWithout) {
  Diagnosis none;
  none.verdict.sentence = "nothing";
  Diagnosis some;
  Cause cause;
  cause.id = "shading";
  cause.title = "partial shading";
  cause.power_effect = {0.02, 0.01, 0.03};
  cause.equivalents = {"weak_cell", "substrings"};
  some.verdict.causes = {cause};
  cause.id = "clip";
  some.verdict.below_floor = {cause};
  const auto lines = LinesOf(CausesCsv({"a", "b"}, {some, none}));
  ASSERT_EQ(lines.size(), 4U);
  ExpectRectangular(lines);
  EXPECT_THAT(lines[1], StartsWith("a,shading,partial shading,yes,"));
  EXPECT_THAT(lines[1], HasSubstr(",0.02,0.01,0.03,"));
  EXPECT_THAT(lines[1], HasSubstr(",weak_cell substrings,"));
  EXPECT_THAT(lines[2], StartsWith("a,clip,partial shading,no,"));
  EXPECT_THAT(lines[3], StartsWith("b,,,no,,"));
  EXPECT_THAT(lines[3], EndsWith(",nothing"));
}

TEST(OutlierSweepsCsv, HasARowASweep) {
  const auto lines = LinesOf(OutlierSweepsCsv(SampleOutlierSweeps()));
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_THAT(lines[1], StartsWith("today,yes,3e-06,series_resistance,8,6.9,9.1,%,-0.0062,"));
  EXPECT_THAT(lines[2], StartsWith("yesterday,no,"));
}

TEST(CertificateCsv, HasTheFloorAndEveryModel) {
  const auto lines = LinesOf(CertificateCsv(RtcCertificate()));
  ASSERT_EQ(lines.size(), 2 + RtcCertificate().models.size());
  ExpectRectangular(lines);
  EXPECT_THAT(lines[1], StartsWith("floor,yes,0.00098248"));
  EXPECT_THAT(lines[2], StartsWith("sd,yes,"));
}

TEST(DataSheetCsv, HasTheRangeWhereThereIsOne) {
  const auto lines = LinesOf(DataSheetCsv(SampleDataSheetFit()));
  ASSERT_EQ(lines.size(), 1 + SampleDataSheetFit().shared.size());
  ExpectRectangular(lines);
  EXPECT_EQ(lines[3], "n1,n,,1.02,1,1.04");
  EXPECT_THAT(lines[1], EndsWith(",4.7,,"));
}

TEST(CsvField, IsQuotedWhereItHasTo) {
  EXPECT_EQ(CsvField("plain"), "plain");
  EXPECT_EQ(CsvField("a, \"b\""), "\"a, \"\"b\"\"\"");
  EXPECT_EQ(CsvField(0.1), "0.1");
  EXPECT_EQ(CsvField(kUnknown), "");
}

}  // namespace
}  // namespace lyrefit
