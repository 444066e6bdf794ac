#include "lyrefit/report/plot_script.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sample_report.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(PlotScript, LabelsTheRmseByTheFittedObjective) {
  FitReport report = SampleReport();
  EXPECT_THAT(PlotScript(report, "svg"), HasSubstr("RMSE 0.000773 A solved-current'"));
  report.objective = Objective::kMeasuredCurrent;
  EXPECT_THAT(PlotScript(report, "svg"), HasSubstr("RMSE 0.0009891 A measured-current'"));
}

TEST(PlotScript, SaysInterruptedAndNotPolished) {
  FitReport report = SampleReport();
  report.interrupted = true;
  report.polished = false;
  EXPECT_THAT(PlotScript(report, "png"), HasSubstr("model, interrupted: RMSE 0.000776 A"));
  EXPECT_THAT(PlotScript(report, "png"), HasSubstr("solved-current, not polished'"));
}

TEST(PlotScript, LeavesOutWhatIsNotFinite) {
  FitReport report = SampleReport();
  report.residual_A[3] = kUnknown;
  EXPECT_THAT(PlotScript(report, "svg"), Not(HasSubstr("nan")));
}

TEST(PlotScript, ChoosesTheTerminal) {
  EXPECT_THAT(PlotScript(SampleReport(), "svg"), HasSubstr("set terminal svg"));
  EXPECT_THAT(PlotScript(SampleReport(), "png"), HasSubstr("set terminal pngcairo"));
}

}  // namespace
}  // namespace lyrefit
