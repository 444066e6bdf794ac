#include "lyrefit/curve/plausibility.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "synthetic/curves.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

IvCurve Clamped(IvCurve curve, double lowest_A, double highest_A) {
  for (double& current : curve.current_A) current = std::clamp(current, lowest_A, highest_A);
  return curve;
}

void ExpectLimit(const IvCurve& curve, const std::vector<const char*>& says) {
  const auto findings = FindEqualReadings(curve);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_FALSE(findings[0].refuse);
  EXPECT_EQ(findings[0].id, "limit");
  for (const char* text : says) EXPECT_THAT(findings[0].sentence, HasSubstr(text));
  for (const int k : findings[0].points) {
    EXPECT_TRUE(curve.current_A[k] == curve.current_A[findings[0].points[0]] ||
                curve.voltage_V[k] == curve.voltage_V[findings[0].points[0]]);
  }
}

TEST(EqualReadingsTest, ALimitBeyondOpenCircuitIsFound) {
  ExpectLimit(Clamped(SyntheticCell(), -0.1, 1), {"exactly the same current -0.1 A", " V up"});
  ExpectLimit(Clamped(SyntheticCell(0), -0.1, 1), {"exactly the same current -0.1 A"});
  ExpectLimit(Clamped(SyntheticModule(), 4, 100), {"exactly the same current 4 A"});
}

TEST(EqualReadingsTest, ALimitBelowShortCircuitIsFoundByItsCorner) {
  ExpectLimit(Clamped(SyntheticCell(), -1, 0.12), {"exactly the same current 0.12 A", " V down"});
  ExpectLimit(Clamped(SyntheticModule(), -100, 8), {"exactly the same current 8 A"});
}

TEST(EqualReadingsTest, ReadingsInAnyOrderCount) {
  IvCurve curve = Clamped(SyntheticCell(), -0.1, 1);
  std::reverse(curve.voltage_V.begin(), curve.voltage_V.end());
  std::reverse(curve.current_A.begin(), curve.current_A.end());
  ExpectLimit(curve, {"-0.1 A"});
  EXPECT_EQ(FindEqualReadings(curve)[0].points.front(), 0);
}

TEST(EqualReadingsTest, ALimitOfTheVoltageIsFoundWhereCurrentsGoOn) {
  IvCurve curve = SyntheticModule();
  for (double& voltage : curve.voltage_V) voltage = std::min(voltage, 36.0);
  ExpectLimit(curve, {"exactly the same voltage 36 V", "high end"});
  // Repeated readings of one operating point are no voltage limit.
  curve = SyntheticModule();
  for (int k = 0; k < 8; ++k) {
    curve.voltage_V.push_back(curve.voltage_V.back());
    curve.current_A.push_back(curve.current_A.back() + 1e-4 * k);
  }
  EXPECT_THAT(FindEqualReadings(curve), IsEmpty());
}

TEST(EqualReadingsTest, TheFlatPartOfACoarseReadingIsNone) {
  for (const int every : {1, 2, 4}) {
    for (const double step : {0.0005, 0.001, 0.005, 0.01}) {
      SCOPED_TRACE(::testing::Message() << "every " << every << ", step " << step);
      for (const double light : {0.0, 1.0}) {
        const IvCurve cell = SyntheticCell(light);
        IvCurve coarse = cell;
        coarse.voltage_V.clear();
        coarse.current_A.clear();
        for (std::size_t k = 0; k < cell.size(); k += every) {
          coarse.voltage_V.push_back(cell.voltage_V[k]);
          coarse.current_A.push_back(std::round(cell.current_A[k] / step) * step);
        }
        EXPECT_THAT(FindEqualReadings(coarse), IsEmpty());
      }
    }
  }
}

TEST(LeaveOutLimitedTest, ReadingsAtTheStatedLimitAreLeftOutAndSaid) {
  IvCurve curve;
  curve.notes.compliance_A = 0.02;
  curve.voltage_V = {0, 0.3, 0.5, 0.6, 0.62, 0.64, 0.66};
  curve.current_A = {0.1, 0.1, 0.09, 0.01, -0.015, -0.02001, -0.01999};
  curve.sweep = {1, 1, 1, 1, 1, 1, 1};
  IvCurve unstated = curve;
  unstated.notes.compliance_A.reset();
  LeaveOutLimited(&curve);
  EXPECT_EQ(curve.size(), 5U);
  EXPECT_EQ(curve.sweep.size(), 5U);
  EXPECT_EQ(curve.voltage_V.back(), 0.62);
  ASSERT_EQ(curve.assumptions.size(), 1U);
  EXPECT_NE(curve.assumptions[0].sentence.find("2 of 7 readings, from 0.64 V up"),
            std::string::npos);
  LeaveOutLimited(&unstated);
  EXPECT_EQ(unstated.size(), 7U);
}

TEST(LeaveOutLimitedTest, NothingIsLeftOutBelowTheLimitOrIfNothingWouldRemain) {
  IvCurve curve;
  curve.notes.compliance_A = 0.02;
  curve.voltage_V = {0, 0.3, 0.5, 0.6};
  curve.current_A = {0.02, 0.02, 0.01, -0.0199};  // Isc is no limit of the source
  LeaveOutLimited(&curve);
  EXPECT_EQ(curve.size(), 4U);
  curve.current_A = {-0.02, -0.02, -0.02, -0.02};
  LeaveOutLimited(&curve);
  EXPECT_EQ(curve.size(), 4U);
}

TEST(LeaveOutPaddingTest, RowsOfZerosWhereTheSweepDoesNotComeAreLeftOut) {
  IvCurve lit = SyntheticModule();
  const std::vector<double> voltage = lit.voltage_V;
  lit.time_s.assign(lit.size(), 1);
  for (std::vector<double>* column : {&lit.voltage_V, &lit.current_A, &lit.time_s}) {
    column->resize(column->size() + 7, 0.0);
  }
  EXPECT_EQ(LeaveOutPadding(0, &lit), 7U);
  EXPECT_EQ(lit.voltage_V, voltage);
  EXPECT_EQ(lit.time_s.size(), voltage.size());
  EXPECT_EQ(LeaveOutPadding(0, &lit), 0U);
}

TEST(LeaveOutPaddingTest, ADarkSweepMayEndAtTheOrigin) {
  IvCurve dark;
  dark.voltage_V = {0.6, 0.4, 0.2, 0};
  dark.current_A = {-1, -0.02, -0.01, 0};
  EXPECT_EQ(LeaveOutPadding(0, &dark), 0U);
  dark.voltage_V.resize(9, 0.0);
  dark.current_A.resize(9, 0.0);
  EXPECT_EQ(LeaveOutPadding(0, &dark), 5U);
  EXPECT_EQ(dark.size(), 4U);
}

TEST(LeaveOutPaddingTest, WithoutAReadingNothingIsLeft) {
  IvCurve empty;
  empty.voltage_V.resize(4, 0.0);
  empty.current_A.resize(4, 0.0);
  EXPECT_EQ(LeaveOutPadding(0, &empty), 4U);
  EXPECT_EQ(empty.size(), 0U);
}

}  // namespace
}  // namespace lyrefit
