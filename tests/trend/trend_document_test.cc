#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "golden.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json.h"
#include "lyrefit/report/page.h"
#include "lyrefit/trend/trend_documents.h"
#include "sample_trend.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(TrendText, SaysWhatTheGoldenFileHas) {
  Golden golden("trend");
  golden.Add("ninety days", TrendText(SampleTrend(90)));
  TrendReport report = SampleTrend(90);
  report.source = TrendSource::kOperatingPoints;
  report.states = {400, 0, 100, 20, 20, 9};
  report.onsets.clear();
  report.quantities[1].changes.clear();
  golden.AddChanges("operating points without a change", TrendText(report));
  report = SampleTrend(12);
  for (TrendLoss& loss : report.losses) {
    loss.energy_percent.low_95 = loss.energy_percent.high_95 = kUnknown;
    loss.now_percent = {};
  }
  for (TrendQuantity& quantity : report.quantities) {
    quantity.rate_per_year = quantity.rate_percent = {};
  }
  report.warnings.clear();
  report.not_decided.clear();
  report.options.clear();
  report.reasons.clear();
  golden.AddChanges("twelve days without intervals and rates", TrendText(report));
  golden.Check();
}

TEST(BriefTrend, IsOneLine) {
  EXPECT_EQ(BriefTrend(SampleTrend(90)),
            "module 7: Since the reference the device gave 3.1 % (2.9 to 3.4) less energy than it "
            "would have given unchanged.\n");
}

TEST(TrendPage, HasTheTextTheFigureAndTheRecord) {
  const TrendReport report = SampleTrend(90);
  const std::string page = DrawPage(TrendDocument(report), TrendJson(report));
  EXPECT_THAT(page, HasSubstr("Losses against the reference"));
  EXPECT_THAT(page, HasSubstr("a step of the series resistance"));
  EXPECT_THAT(page, HasSubstr("the line is the regression"));
  EXPECT_THAT(page, HasSubstr("\"reference_power_W\""));
}

TEST(TrendPage, EscapesWhatFilesAreCalled) {
  TrendReport report = SampleTrend(40);
  report.name = "<script>alert(1)</script>";
  report.law = "<b>law</b>";
  report.reasons[0].reason = "<i>reason</i>";
  const std::string page = DrawPage(TrendDocument(report), TrendJson(report));
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, Not(HasSubstr("<b>law")));
  EXPECT_THAT(page, Not(HasSubstr("<i>reason")));
}

}  // namespace
}  // namespace lyrefit
