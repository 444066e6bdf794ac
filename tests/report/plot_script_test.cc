#include "lyrefit/report/plot_script.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>

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

// "set yrange [LOW:HIGH]": where zero lies between them, from 0 to 1.
double ZeroOf(const std::string& script, const std::string& axis) {
  const std::size_t at = script.find("set " + axis + " [");
  double low = 0, high = 0;
  EXPECT_EQ(std::sscanf(script.c_str() + at + axis.size() + 6, "%lf:%lf", &low, &high), 2);
  return -low / (high - low);
}

// A long tail beyond open circuit, where power falls further than current.
TEST(PlotScript, HasTheZerosOfBothAxesAtOneHeightOrDrawsBoth) {
  FitReport report = SampleReport();
  report.curve.current_A.back() = -4;
  const std::string tail = PlotScript(report, "svg");
  EXPECT_NEAR(ZeroOf(tail, "yrange"), ZeroOf(tail, "y2range"), 1e-9);
  EXPECT_THAT(tail, Not(HasSubstr("0 axes x1y2")));
  // Deep reverse bias: much negative power, no negative current.
  report = SampleReport();
  report.curve.voltage_V.front() = -40;
  EXPECT_THAT(PlotScript(report, "svg"), HasSubstr("0 axes x1y2"));
}

TEST(PlotScript, DrawsNoMoreMarksThanCanBeToldApart) {
  FitReport report = SampleReport();
  for (int i = 0; i < 12; ++i) {
    for (auto* values : {&report.curve.voltage_V, &report.curve.current_A, &report.residual_A,
                         &report.model_current_A}) {
      const std::vector<double> copy = *values;
      values->insert(values->end(), copy.begin(), copy.end());
    }
  }
  ASSERT_GT(report.curve.size(), 100000U);
  EXPECT_LT(PlotScript(report, "svg").size(), 300000U);
}

TEST(PlotScript, ChoosesTheTerminal) {
  EXPECT_THAT(PlotScript(SampleReport(), "svg"), HasSubstr("set terminal svg"));
  EXPECT_THAT(PlotScript(SampleReport(), "png"), HasSubstr("set terminal pngcairo"));
}

}  // namespace
}  // namespace lyrefit
