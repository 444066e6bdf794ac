#include "lyrefit/certify/floor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/read/read_curve.h"

namespace lyrefit {
namespace {

IvCurve RtcCell() { return *ReadCurve(LYREFIT_DATA_DIR "/rtc_france"); }

TEST(Floor, OfOneDiodeIsWhatTwoDiodesReach) {
  FitOptions options;
  options.objective = Objective::kMeasuredCurrent;
  options.intervals = Intervals::kNone;
  options.floor = true;
  const auto report = FitWithFloor(RtcCell(), options, false);
  ASSERT_TRUE(report.has_value());
  ASSERT_TRUE(report->floor.has_value());
  EXPECT_NEAR(report->floor->rmse_A, 9.824848761e-4, 1e-12);
  EXPECT_NEAR(report->floor->lower_bound_A, 9.824848761e-4, 1e-12);
  EXPECT_NEAR(report->floor->above, 9.860218779 / 9.824848761 - 1, 1e-8);
  EXPECT_EQ(report->floor->objective, Objective::kMeasuredCurrent);
  EXPECT_TRUE(report->floor->minimised);
  EXPECT_EQ(report->floor->n_lower, 1);
  EXPECT_EQ(report->floor->n_upper, 2);
}

// The solved-current floor is 7.326480809e-4 A, see the table of data/README.md.
TEST(Floor, IsOfTheObjectiveThatIsFitted) {
  FitOptions options;
  options.intervals = Intervals::kNone;
  options.floor = true;
  const auto one = FitWithFloor(RtcCell(), options, false);
  ASSERT_TRUE(one.has_value() && one->floor.has_value());
  EXPECT_EQ(one->floor->objective, Objective::kSolvedCurrent);
  EXPECT_LE(one->floor->lower_bound_A, 7.326480809e-4);
  EXPECT_GT(one->floor->lower_bound_A, 7.326480809e-4 * (1 - 2e-6));
  EXPECT_NEAR(one->floor->above, 7.730062690 / 7.326480809 - 1, 2e-6);
  options.model = Model::kDoubleDiode;
  const auto two = FitWithFloor(RtcCell(), options, false);
  ASSERT_TRUE(two.has_value() && two->floor.has_value());
  EXPECT_EQ(two->floor->above, 0) << "the answer is no worse than any mixture that was met";
  EXPECT_LE(two->floor->gap, 1e-6);
}

TEST(Floor, IsNotLookedForBelowAFitThatIsNotUsable) {
  IvCurve curve = RtcCell();
  for (std::size_t k = 0; k < curve.size(); k += 2) curve.current_A[k] *= 0.5;
  FitOptions options;
  options.intervals = Intervals::kNone;
  options.floor = true;
  const auto report = FitWithFloor(curve, options, false);
  ASSERT_TRUE(report.has_value());
  EXPECT_FALSE(report->usable);
  EXPECT_FALSE(report->floor.has_value());
  EXPECT_THAT(report->warnings,
              ::testing::Contains(::testing::HasSubstr("No floor was looked for")));
}

TEST(Floor, FollowsTheBoundsOfTheFit) {
  FitOptions options;
  options.intervals = Intervals::kNone;
  options.floor = true;
  options.bounds.overrides["n"] = {0.5, 4};
  options.objective = Objective::kMeasuredCurrent;
  const auto measured = FitWithFloor(RtcCell(), options, false);
  ASSERT_TRUE(measured.has_value() && measured->floor.has_value());
  EXPECT_NEAR(measured->floor->rmse_A, 9.449435199e-4, 1e-12);
  options.objective = Objective::kSolvedCurrent;
  const auto solved = FitWithFloor(RtcCell(), options, false);
  ASSERT_TRUE(solved.has_value() && solved->floor.has_value());
  EXPECT_NEAR(solved->floor->rmse_A, 6.520276720e-4, 1e-9);
  EXPECT_LE(solved->floor->gap, 1e-6);
}

TEST(Floor, SaysWhereTheFitMinimisesSomethingElse) {
  FitOptions options;
  options.intervals = Intervals::kNone;
  options.floor = true;
  options.loss = Loss::kHuber;
  const auto robust = FitWithFloor(RtcCell(), options, false);
  ASSERT_TRUE(robust.has_value() && robust->floor.has_value());
  EXPECT_FALSE(robust->floor->minimised);
  options.loss = Loss::kSquared;
  IvCurve weighed = RtcCell();
  weighed.sigma_A.assign(weighed.size(), 1e-3);
  weighed.sigma_A[3] = 1e-4;
  const auto by_sigma = FitWithFloor(weighed, options, false);
  ASSERT_TRUE(by_sigma.has_value() && by_sigma->floor.has_value());
  EXPECT_FALSE(by_sigma->floor->minimised);
  EXPECT_GT(by_sigma->floor->above, 0.05);
}

TEST(Floor, OfALongSweepIsLookedForInTheMeasuredCurrentOnly) {
  IvCurve sweep = RtcCell();
  sweep.voltage_V.clear();
  sweep.current_A.clear();
  const double short_circuit_A = 0.76, saturation_A = 3e-7, thermal_V = 0.0389;
  for (int k = 0; k <= 2000; ++k) {
    const double v = 0.57 * k / 2000;
    sweep.voltage_V.push_back(v);
    sweep.current_A.push_back(short_circuit_A - saturation_A * std::expm1(v / thermal_V) +
                              1e-3 * std::sin(1.0 * k));
  }
  FitOptions options;
  options.intervals = Intervals::kNone;
  options.floor = true;
  const auto solved = FitWithFloor(sweep, options, false);
  ASSERT_TRUE(solved.has_value());
  EXPECT_FALSE(solved->floor.has_value());
  EXPECT_NE(solved->warnings.back().find("2001 readings"), std::string::npos);
  options.objective = Objective::kMeasuredCurrent;
  const auto measured = FitWithFloor(sweep, options, false);
  ASSERT_TRUE(measured.has_value());
  EXPECT_TRUE(measured->floor.has_value());
}

TEST(Floor, IsNotLookedForUnlessAsked) {
  const auto report = FitWithFloor(RtcCell(), {}, false);
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
  const auto report = FitWithFloor(dark, options, false);
  ASSERT_TRUE(report.has_value()) << report.error().ToString();
  EXPECT_FALSE(report->floor.has_value());
  EXPECT_NE(report->warnings.back().find("No floor"), std::string::npos);
}

TEST(RangesOf, CoverEveryDiode) {
  std::vector<ParameterBounds> bounds(9);
  bounds[kIph] = {0, 2, 0, 2, SearchScale::kLinear};
  bounds[kRsh] = {10, 100, 10, 100, SearchScale::kLinear};
  bounds[SaturationCurrentIndex(2)] = {0, 1e-3, 0, 1e-3, SearchScale::kLinear};
  bounds[IdealityIndex(0)] = {1, 1.5, 1, 1.5, SearchScale::kLinear};
  bounds[IdealityIndex(1)] = {2, 2, 2, 2, SearchScale::kLinear};
  bounds[IdealityIndex(2)] = {0.8, 3, 0.8, 3, SearchScale::kLinear};
  const CertifyOptions options = RangesOf(bounds, ConstantSet::kCodata, {});
  EXPECT_EQ(options.n_lower, 0.8);
  EXPECT_EQ(options.n_upper, 3);
  EXPECT_EQ(options.iph_upper_A, 2);
  EXPECT_EQ(options.rsh_lower_ohm, 10);
  ASSERT_EQ(options.diodes.size(), 3U);
  EXPECT_EQ(options.diodes[1].n_lower, 2);
  EXPECT_EQ(options.diodes[2].is_upper_A, 1e-3);
}

}  // namespace
}  // namespace lyrefit
