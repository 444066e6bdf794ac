#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "lyrefit/devices/device_documents.h"
#include "lyrefit/devices/fit_two_junctions.h"
#include "lyrefit/model/two_junctions.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json.h"
#include "lyrefit/report/plots.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

TwoJunctionReport TandemReport() {
  const std::vector<double> p = {0.0195, 1e-14, 1.4, 3000, 0.0202, 3e-10, 1.2, 1500, 2.0};
  CurveSet set;
  set.name = "tandem";
  for (const double bottom : {1.0, 0.8}) {
    IvCurve curve;
    curve.name = bottom == 1 ? "white" : "red";
    curve.notes.light_top = 1;
    curve.notes.light_bottom = bottom;
    std::vector<double> at = p;
    at[JunctionPhotocurrent(1)] *= bottom;
    for (int k = 0; k < 30; ++k) {
      curve.voltage_V.push_back(1.62 * k / 29);
      curve.current_A.push_back(
          TwoJunctionCurrent(ThermalVoltage(298.15), at.data(), curve.voltage_V.back()));
    }
    set.curves.push_back(std::move(curve));
  }
  TwoJunctionOptions options;
  options.intervals = Intervals::kSymmetric;
  return FitTwoJunctions(set, options).value();
}

TEST(TwoJunctionDocument, NamesParametersLightsAndObjective) {
  TwoJunctionReport report = TandemReport();
  report.estimates[3].identifiable = false;
  report.estimates[3].reason = "only a lower limit is known";
  report.decided_by = {"Rsh1: a red spectrum decides"};
  const std::string text = TwoJunctionText(report);
  for (const char* part :
       {"two junctions in series behind tandem", "solved-current *",
        "Rsh1 is not identifiable: only", "a red spectrum decides", "1 is the top one"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
  EXPECT_THAT(BriefTwoJunctions(report), HasSubstr("not identifiable: Rsh1"));
}

TEST(TwoJunctionDocument, ThePictureHasPointsModelAndResidualsOfEveryCurve) {
  const Figure figure = TwoJunctionFigure(TandemReport());
  ASSERT_EQ(figure.panels.size(), 2U);
  EXPECT_EQ(figure.panels[0].series.size(), 4U);
  EXPECT_EQ(figure.panels[1].series.size(), 2U);
}

TEST(TwoJunctionJson, HoldsTheReport) {
  const TwoJunctionReport report = TandemReport();
  const auto json = nlohmann::json::parse(TwoJunctionJson(report));
  EXPECT_EQ(json["junctions"], 2);
  EXPECT_EQ(json["parameters"]["n_1"]["refined"], report.estimates[2].refined);
  EXPECT_EQ(json["curves"][1]["light"]["bottom"], 0.8);
  EXPECT_EQ(json["curves"][1]["limiting"], 2);
  EXPECT_TRUE(json["rmse"]["refined"]["measured_current_A"].is_null());
  EXPECT_EQ(json["rmse"]["refined"]["solved_current_A"], report.rmse.refined.solved_current_A);
}

}  // namespace
}  // namespace lyrefit
