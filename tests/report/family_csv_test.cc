#include "lyrefit/report/family_csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sample_family.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

FamilyReport TwoCurves() {
  FamilyReport report;
  report.cells_in_series = 60;
  report.curves.resize(2);
  report.curves[0].id = "1";
  report.curves[0].parameters = {1, 2, 3, 4, 5};
  report.curves[0].free_parameters = {6.1, 1.25e-10, 1.1, 0.3, 400};
  report.curves[1].id = "2,b";
  report.curves[1].parameters = {6, 1e-9, 1, 0.25, 500};
  return report;
}

TEST(FreeFitsCsv, HasTheColumnsOfThePublishedParameterSets) {
  EXPECT_EQ(FreeFitsCsv(TwoCurves()),
            "Index,photocurrent,saturation_current,resistance_series,resistance_shunt,n,"
            "cells_in_series\n"
            "1,6.1,1.25e-10,0.3,400,1.1,60\n"
            "\"2,b\",6,1e-09,0.25,500,1,60\n");
}

TEST(FreeFitsCsv, AddsTheSecondDiode) {
  FamilyReport report = TwoCurves();
  report.translation.spec.model = Model::kDoubleDiode;
  report.curves[0].free_parameters.insert(report.curves[0].free_parameters.end(), {1e-7, 2});
  const std::string csv = FreeFitsCsv(report);
  EXPECT_THAT(csv, HasSubstr(",cells_in_series,saturation_current_2,n_2\n"));
  EXPECT_THAT(csv, HasSubstr("\n1,6.1,1.25e-10,0.3,400,1.1,60,1e-07,2\n"));
}

TEST(FreeFitsCsv, KeepsTheRowOfACurveWithoutParameters) {
  FamilyReport report = TwoCurves();
  report.curves[0].parameters.clear();
  report.curves[0].free_parameters.clear();
  EXPECT_THAT(FreeFitsCsv(report), HasSubstr("\n1,,,,,,60\n"));
}

}  // namespace
}  // namespace lyrefit
