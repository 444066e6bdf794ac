#include "lyrefit/fit/floor.h"

#include <gtest/gtest.h>

#include "lyrefit/curve/read_curve.h"
#include "lyrefit/fit/fit.h"

namespace lyrefit {
namespace {

IvCurve RtcCell() { return *ReadCurve(LYREFIT_DATA_DIR "/rtc_france"); }

TEST(Floor, OfOneDiodeIsWhatTwoDiodesReach) {
  FitOptions options;
  options.objective = Objective::kMeasuredCurrent;
  options.intervals = Intervals::kNone;
  options.floor = true;
  const auto report = Fit(RtcCell(), options);
  ASSERT_TRUE(report.has_value());
  ASSERT_TRUE(report->floor.has_value());
  EXPECT_NEAR(report->floor->rmse_A, 9.824848761e-4, 1e-12);
  EXPECT_NEAR(report->floor->lower_bound_A, 9.824848761e-4, 1e-12);
  EXPECT_NEAR(report->floor->above, 9.860218779 / 9.824848761 - 1, 1e-8);
  EXPECT_EQ(report->floor->n_lower, 1);
  EXPECT_EQ(report->floor->n_upper, 2);
}

TEST(Floor, FollowsTheBoundsOfTheFit) {
  FitOptions options;
  options.intervals = Intervals::kNone;
  options.floor = true;
  options.bounds.overrides["n"] = {0.5, 4};
  const auto report = Fit(RtcCell(), options);
  ASSERT_TRUE(report.has_value() && report->floor.has_value());
  EXPECT_NEAR(report->floor->rmse_A, 9.449435199e-4, 1e-12);
  EXPECT_GT(report->floor->above, 0.04) << "the solved-current fit, in measured-current RMSE";
}

TEST(Floor, IsNotLookedForUnlessAsked) {
  const auto report = Fit(RtcCell());
  ASSERT_TRUE(report.has_value());
  EXPECT_FALSE(report->floor.has_value());
}

TEST(Floor, OfACurveThatHasNoneIsAWarningNotAnError) {
  IvCurve dark = RtcCell();
  for (double& i : dark.current_A) i -= 0.7605;
  for (double& i : dark.current_A) i = i > 0 ? -1e-6 : i;
  FitOptions options;
  options.intervals = Intervals::kNone;
  options.floor = true;
  const auto report = Fit(dark, options);
  ASSERT_TRUE(report.has_value()) << report.error().ToString();
  EXPECT_FALSE(report->floor.has_value());
  EXPECT_NE(report->warnings.back().find("No floor"), std::string::npos);
}

TEST(RangesOf, CoverEveryDiode) {
  std::vector<ParameterBounds> bounds(9);
  bounds[IdealityIndex(0)] = {1, 1.5, 1, 1.5, SearchScale::kLinear};
  bounds[IdealityIndex(1)] = {2, 2, 2, 2, SearchScale::kLinear};
  bounds[IdealityIndex(2)] = {0.8, 3, 0.8, 3, SearchScale::kLinear};
  const CertifyOptions options = RangesOf(bounds, ConstantSet::kCodata, {});
  EXPECT_EQ(options.n_lower, 0.8);
  EXPECT_EQ(options.n_upper, 3);
}

}  // namespace
}  // namespace lyrefit
