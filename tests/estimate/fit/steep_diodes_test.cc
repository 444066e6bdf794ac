#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/model/term.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/settings/bounds_file.h"

// Diodes with an n so small that their exponents are cut at a reading.
namespace lyrefit {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

const char kFolder[] = LYREFIT_DATA_DIR "/pwp201";

FitReport FitIn(const BoundsSpec& bounds, Model model) {
  FitOptions options;
  options.model = model;
  options.objective = Objective::kMeasuredCurrent;
  options.bounds = bounds;
  options.intervals = Intervals::kNone;
  return *Fit(*ReadCurve(kFolder), options);
}

// The exponent of the third diode is 283 at the last reading.
TEST(SteepDiodes, ReachTheBestThreeOfTheSolvedCurrent) {
  FitOptions options;
  options.model = Model::kTripleDiode;
  options.bounds = *NamedBounds("literature", kFolder);
  options.intervals = Intervals::kNone;
  for (options.search.seed = 0; options.search.seed < 3; ++options.search.seed) {
    const auto report = Fit(*ReadCurve(kFolder), options);
    ASSERT_TRUE(report) << report.error().ToString();
    EXPECT_LE(report->rmse.refined.solved_current_A, 1.0797463265e-3) << options.search.seed;
  }
}

// Lower bound of the RMSE for any sum of diodes with n in these bounds. A lower RMSE takes a step
// function among them.
constexpr double kFloor_A = 1.603618380e-3;

TEST(SteepDiodes, AreLeftOutWhereTheirExponentIsCut) {
  const FitReport report = FitIn(*NamedBounds("literature", kFolder), Model::kTripleDiode);
  EXPECT_GE(report.rmse.refined.measured_current_A, kFloor_A);
  EXPECT_TRUE(report.usable);
  EXPECT_NEAR(report.steepest_n, 0.05537, 1e-5);
  EXPECT_THAT(report.warnings, Contains(AllOf(HasSubstr("n begins at 0.05537"),
                                              HasSubstr("certify takes the bounds as they are"))));
  for (const Estimate& e : report.estimates) {
    if (e.info.symbol[0] != 'n') continue;
    EXPECT_EQ(e.bounds.lower, report.steepest_n);
    for (const double v : report.curve.voltage_V) {
      EXPECT_LE(v / (e.refined * report.device.module_thermal_voltage_V),
                kLargestExponent * (1 + 1e-12));
    }
  }
}

TEST(SteepDiodes, AreNoConcernOfOtherBounds) {
  BoundsSpec bounds = *NamedBounds("literature", kFolder);
  bounds.overrides["n"] = {0.06, 1.3};
  for (const BoundsSpec& spec : {bounds, *NamedBounds("physical", kFolder)}) {
    const FitReport report = FitIn(spec, Model::kDoubleDiode);
    EXPECT_TRUE(std::isnan(report.steepest_n));
    EXPECT_THAT(report.warnings, Not(Contains(HasSubstr("n begins at"))));
  }
}

TEST(SteepDiodes, MayBeHeldByHand) {
  FitOptions options;
  options.bounds = *NamedBounds("literature", kFolder);
  options.fixed["n"] = 0.05;
  options.intervals = Intervals::kNone;
  const auto report = Fit(*ReadCurve(kFolder), options);
  ASSERT_TRUE(report) << report.error().ToString();
  EXPECT_EQ(report->estimates[2].refined, 0.05);
  EXPECT_TRUE(std::isnan(report->steepest_n));
}

}  // namespace
}  // namespace lyrefit
