#include "lyrefit/diagnose/values.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/diagnose/measurement.h"
#include "lyrefit/model/make_readings.h"
#include "synthetic/curves.h"

namespace lyrefit {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<double> Rounded(std::vector<double> values, double step, double digit = 0) {
  for (double& value : values) {
    value = step * std::round(value / step);
    if (digit > 0) value = digit * std::round(value / digit);
  }
  return values;
}

ValueFindings Look(const IvCurve& curve) {
  std::vector<std::string> warnings;
  const auto made = MakeReadings(SetOf({curve}), &warnings);
  EXPECT_TRUE(made.has_value());
  return LookAtValues(*made);
}

// |dI/dV| of a cell divided by its largest current, in 1/V.
double Slope(const IvCurve& curve, std::size_t k) {
  const double dv = curve.voltage_V[k + 2] - curve.voltage_V[k - 2];
  return std::fabs((curve.current_A[k + 2] - curve.current_A[k - 2]) / dv / curve.current_A[0]);
}

TEST(FindGridTest, FindsTheStep) {
  const std::vector<double> current = SyntheticCurve({}).current_A;
  for (const double step : {0.4, 0.05, 0.02}) {
    EXPECT_NEAR(FindGrid(Rounded(current, step)), step, 1e-9) << step;
  }
}

// Files may print fewer digits than the rounding step of the instrument has.
TEST(FindGridTest, FindsTheStepBehindDigits) {
  const std::vector<double> current = SyntheticCurve({}).current_A;
  for (const double step : {1.0 / 7, 10.0 / 256}) {
    EXPECT_NEAR(FindGrid(Rounded(current, step, 1e-4)), step, 2e-6) << step;
  }
}

TEST(FindGridTest, SeesNoneInFineValues) {
  EXPECT_EQ(FindGrid(SyntheticCurve({}).current_A), 0);
  EXPECT_EQ(FindGrid(Rounded(SyntheticCurve({}).current_A, 1e-4)), 0);
}

TEST(FindGridTest, SeesNoneInFewOrEqualValues) {
  EXPECT_EQ(FindGrid({}), 0);
  EXPECT_EQ(FindGrid({1, 2, 3, 4, 5}), 0);
  EXPECT_EQ(FindGrid(std::vector<double>(30, 2.5)), 0);
  EXPECT_EQ(FindGrid({0, 0, 0, 0, 0, 1, 1, 1, 1, 1}), 0);
}

TEST(LookAtValuesTest, FindsClippedReadings) {
  IvCurve curve = SyntheticCurve({});
  int clipped = 0;
  for (double& i : curve.current_A) {
    clipped += i > 7.95;
    i = std::min(i, 7.95);
  }
  const ValueFindings findings = Look(curve);
  EXPECT_NEAR(findings.clip_level, 1, 1e-12);  // the largest current is the scale
  EXPECT_EQ(static_cast<int>(findings.clipped.size()), clipped);
  EXPECT_EQ(findings.clipped.front(), 0);
}

// A source meter holds the current at its compliance limit.
TEST(LookAtValuesTest, FindsALowerLimit) {
  IvCurve curve = SyntheticCurve({});
  const double limit = curve.current_A[curve.size() - 6];
  for (double& i : curve.current_A) i = std::max(i, limit);
  const ValueFindings findings = Look(curve);
  ASSERT_TRUE(findings.limited);
  EXPECT_EQ(findings.at_lower.size(), 6U);
  EXPECT_EQ(findings.clip_level, 0);
  curve = SyntheticCurve({});
  for (std::size_t k = curve.size() - 2; k < curve.size(); ++k) {
    curve.current_A[k] = curve.current_A[curve.size() - 2];
  }
  EXPECT_FALSE(Look(curve).limited);  // two readings at one value are no limit
}

// A limit that the file states is one from the first reading at it on.
TEST(LookAtValuesTest, BelievesAStatedLimit) {
  IvCurve curve = SyntheticCurve({});
  const double limit_A = 1.1 * curve.current_A[0];
  const int last = static_cast<int>(curve.size()) - 1;
  curve.current_A[last - 1] = curve.current_A[last] = -limit_A;
  EXPECT_FALSE(Look(curve).limited);  // two readings at one value
  std::vector<std::string> warnings;
  const auto readings = MakeReadings(SetOf({curve}), &warnings);
  ASSERT_TRUE(readings);
  const double limit = limit_A / readings->scale.current_A;
  const ValueFindings findings = LookAtValues(*readings, limit);
  EXPECT_TRUE(findings.limited);
  EXPECT_THAT(findings.at_lower, ElementsAre(last - 1, last));
  EXPECT_DOUBLE_EQ(findings.lower_limit, -limit);
  EXPECT_EQ(findings.clip_level, 0);
  EXPECT_FALSE(LookAtValues(*readings, 2 * limit).HasLimits());
}

// A meter of its own reads the held current with its own last digits.
TEST(LookAtValuesTest, FindsALowerLimitInReadingsOfItsLastDigits) {
  IvCurve curve = SyntheticCurve({});
  const double limit = std::min(curve.current_A.back(), 0.0) - 0.4;
  for (const double part : {1.0, 1.00002, 0.99998}) {
    curve.voltage_V.push_back(curve.voltage_V.back() + 0.5);
    curve.current_A.push_back(limit * part);
  }
  const ValueFindings findings = Look(curve);
  ASSERT_TRUE(findings.limited);
  EXPECT_EQ(findings.at_lower.size(), 3U);
}

// An electronic load holds a limit with its noise. Such readings are left out without a cause, if the
// voltage went on so far that the current would have fallen.
TEST(LookAtValuesTest, LeavesOutANoisyLowerLimit) {
  for (const double step_V : {0.5, 1e-4}) {
    IvCurve curve = SyntheticCurve({});
    const double limit = std::min(curve.current_A.back(), 0.0) - 0.4;
    for (const double part : {0.999, 1.0, 1.002, 0.998, 1.001, 1.0}) {
      curve.voltage_V.push_back(curve.voltage_V.back() + step_V);
      curve.current_A.push_back(limit * part);
    }
    const ValueFindings findings = Look(curve);
    EXPECT_FALSE(findings.HasLimits());
    EXPECT_EQ(findings.at_lower.size(), step_V > 0.1 ? 6U : 0U);
  }
}

TEST(LookAtValuesTest, ThreeRepeatsAreNoClipping) {
  IvCurve curve = SyntheticCurve({});
  for (const int k : {0, 1, 2}) curve.current_A[k] = 8.1;
  EXPECT_EQ(Look(curve).clip_level, 0);
  EXPECT_THAT(Look(curve).clipped, IsEmpty());
}

TEST(LookAtValuesTest, AFlatTopOfACoarseGridIsNoClipping) {
  IvCurve curve = SyntheticCurve({});
  curve.current_A = Rounded(curve.current_A, 0.1);
  const ValueFindings findings = Look(curve);
  EXPECT_GT(findings.grids.lit, 0);
  EXPECT_EQ(findings.clip_level, 0);
}

TEST(LookAtValuesTest, CleanCurvesShowNothing) {
  const ValueFindings findings = Look(SyntheticCurve({}));
  EXPECT_EQ(findings.grids.lit, 0);
  EXPECT_EQ(findings.grids.dark, 0);
  EXPECT_EQ(findings.clip_level, 0);
  EXPECT_FALSE(findings.limited);
  EXPECT_THAT(findings.clipped, IsEmpty());
  EXPECT_THAT(findings.rounding, Each(0));
}

// Dark currents are measured in another instrument range.
TEST(LookAtValuesTest, DarkCurvesHaveTheirOwnGrid) {
  IvCurve lit = SyntheticCurve({}), dark = SyntheticDarkCurve();
  lit.current_A = Rounded(lit.current_A, 0.1);
  dark.current_A = Rounded(dark.current_A, 0.02);
  std::vector<std::string> warnings;
  const auto made = MakeReadings(SetOf({lit, dark}), &warnings);
  ASSERT_TRUE(made.has_value());
  const ValueFindings findings = LookAtValues(*made);
  const double scale = made->scale.current_A;
  EXPECT_NEAR(findings.grids.lit * scale, 0.1, 1e-9);
  EXPECT_NEAR(findings.grids.dark * scale, 0.02, 1e-9);
}

// Equal neighbouring values share one rounding error.
TEST(LookAtValuesTest, NeighboursShareTheirRounding) {
  IvCurve curve = SyntheticCurve({});
  curve.current_A = Rounded(curve.current_A, 0.5);
  const ValueFindings findings = Look(curve);
  ASSERT_GT(findings.grids.lit, 0);
  std::size_t run = 1;
  while (curve.current_A[run] == curve.current_A[0]) ++run;
  ASSERT_GT(run, 5U);
  EXPECT_NEAR(findings.rounding[0], findings.grids.lit * std::sqrt(run / 12.0), 1e-12);
  EXPECT_EQ(findings.rounding[0], findings.rounding[run - 1]);
}

TEST(FindBinsTest, FindsVoltagesThatWereRounded) {
  for (const double bin : {0.007, 0.017, 0.03}) {  // the readings are 0.0113 V apart
    const IvCurve exact = SyntheticCurve({});
    IvCurve curve = exact;
    curve.voltage_V = Rounded(curve.voltage_V, bin);
    const ValueFindings findings = Look(curve);
    EXPECT_NEAR(findings.voltage_bin, bin, 1e-9);
    EXPECT_TRUE(findings.at_voltage_limit.empty());
    // Standard deviation of the rounding within a voltage bin, times the slope.
    double steep = 0, expected = 0;
    for (std::size_t k = curve.size() - 9; k < curve.size() - 3; ++k) {
      steep += findings.bin_rounding[k];
      expected += bin / std::sqrt(12) * Slope(exact, k);
    }
    EXPECT_NEAR(steep, expected, 0.25 * expected) << bin;
    EXPECT_LT(findings.bin_rounding[10], 0.01 * steep);
  }
}

TEST(FindBinsTest, FindsReadingsThatDriftThroughTheirBins) {
  for (const double bin : {0.0101, 0.0127}) {  // every tenth value is skipped or repeated
    IvCurve curve = SyntheticCurve({});
    curve.voltage_V = Rounded(curve.voltage_V, bin);
    const ValueFindings findings = Look(curve);
    EXPECT_NEAR(findings.voltage_bin, bin, 1e-9);
    EXPECT_NEAR(findings.bins_shared, 0.0113 / std::fabs(0.0113 - bin), 2) << bin;
  }
  // Programmed voltages with gaps are not rounded voltages.
  IvCurve curve = SyntheticCurve({});
  for (std::size_t k = 0; k < curve.size(); ++k) curve.voltage_V[k] = 0.0113 * k;
  for (const int k : {11, 15, 31, 32, 44}) {
    curve.voltage_V.erase(curve.voltage_V.begin() + k);
    curve.current_A.erase(curve.current_A.begin() + k);
  }
  EXPECT_EQ(Look(curve).voltage_bin, 0);
}

// A source steps through programmed voltages, coarsely at first, finely at the knee. This is no
// rounding.
TEST(FindBinsTest, TakesSetVoltagesForWhatTheyAre) {
  EXPECT_EQ(Look(SyntheticCurve({})).voltage_bin, 0);
  IvCurve curve = SyntheticCurve({});
  for (std::size_t k = 0; k < curve.size(); ++k) {
    curve.voltage_V[k] = k < 20 ? 0.02 * k : 0.4 + 0.005 * (k - 20);
    curve.current_A[k] = 8 - 1e-8 * std::exp(curve.voltage_V[k] / 0.03);
  }
  EXPECT_EQ(Look(curve).voltage_bin, 0);
  EXPECT_THAT(Look(curve).bin_rounding, Each(0));
}

// A person sets a few round voltages, closer at the knee.
TEST(FindBinsTest, AFewRoundVoltagesAreNoBins) {
  IvCurve curve = SyntheticCurve({});
  curve.voltage_V = {0, 0.2, 0.4, 0.5, 0.55, 0.6, 0.62, 0.64, 0.66, 0.67};
  curve.current_A = {8, 7.99, 7.95, 7.6, 6.9, 5.1, 4.1, 2.6, 1.0, 0.2};
  EXPECT_EQ(Look(curve).voltage_bin, 0);
}

TEST(LookAtValuesTest, FindsALimitOfTheVoltage) {
  IvCurve curve = SyntheticCurve({});
  const double limit = curve.voltage_V[curve.size() - 7];
  for (double& v : curve.voltage_V) v = std::min(v, limit);
  const ValueFindings findings = Look(curve);
  EXPECT_EQ(findings.at_voltage_limit.size(), 7U);
  EXPECT_NEAR(findings.voltage_limit, limit, 1e-12);
  EXPECT_TRUE(findings.HasLimits());
}

// The load holds the device at one operating point: current and voltage both stand still, and all
// readings are valid.
TEST(LookAtValuesTest, SeesNoLimitWhereTheCurrentStandsStillAsWell) {
  IvCurve curve = SyntheticCurve({});
  const std::size_t last = curve.size() - 7;
  for (std::size_t k = last; k < curve.size(); ++k) {
    curve.voltage_V[k] = curve.voltage_V[last];
    curve.current_A[k] = curve.current_A[last] * (1 + 1e-4 * (k % 2));
  }
  EXPECT_THAT(Look(curve).at_voltage_limit, IsEmpty());
  EXPECT_FALSE(Look(SyntheticCurve({})).HasLimits());
}

// The sweeps of a family end at the same voltage, each with one reading.
TEST(ValuesTest, TheCommonEndOfSweepsIsNoLimitOfTheVoltage) {
  std::vector<IvCurve> curves;
  for (const double irradiance : {200.0, 400.0, 600.0, 800.0, 1000.0}) {
    Recipe recipe;
    recipe.name = std::to_string(irradiance);
    recipe.irradiance_W_m2 = irradiance;
    curves.push_back(SyntheticCurve(recipe));
  }
  const auto made = MakeMeasurement(SetOf(curves));
  ASSERT_TRUE(made);
  EXPECT_TRUE(made->values.at_voltage_limit.empty());
}

}  // namespace
}  // namespace lyrefit
