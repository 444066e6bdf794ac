#include "lyrefit/curve/curve_kind.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/base/random.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

IvCurve SweptFrom(double from_V, double to_V) {
  IvCurve curve;
  for (double voltage = from_V; voltage <= to_V + 1e-9; voltage += 0.01) {
    curve.voltage_V.push_back(voltage);
    curve.current_A.push_back(0.04 - 1e-11 * std::expm1(voltage / 0.0257));
  }
  return curve;
}

TEST(CurveKindTest, ASweepFromShortToOpenCircuitNeedsNoWords) {
  const KindOfMeasurement found = KindOf(SweptFrom(-0.02, 0.57));
  EXPECT_EQ(found.kind, CurveKind::kLit);
  EXPECT_EQ(found.words, "");
}

TEST(CurveKindTest, TheExtentOfASweepIsTold) {
  EXPECT_THAT(KindOf(SweptFrom(0.1, 0.57)).words, HasSubstr("begins at 0.1 V"));
  EXPECT_THAT(KindOf(SweptFrom(0, 0.53)).words, HasSubstr("ends at 0.53 V, before open circuit"));
  EXPECT_THAT(KindOf(SweptFrom(0, 0.3)).words, HasSubstr("before the maximum power"));
  EXPECT_THAT(KindOf(SweptFrom(0, 0.65)).words, HasSubstr("more than its Isc of 0.04 A"));
  const KindOfMeasurement both = KindOf(SweptFrom(0.1, 0.53));
  EXPECT_EQ(both.kind, CurveKind::kEndsEarly);
  EXPECT_THAT(both.words, HasSubstr("short-circuit current is not measured; ends"));
}

TEST(CurveKindTest, AFlashHasTheLightOfEachReadingWithinAPulse) {
  IvCurve curve = SweptFrom(0, 0.57);
  for (std::size_t k = 0; k < curve.size(); ++k) {
    curve.time_s.push_back(1e-4 * static_cast<double>(k));
    curve.irradiance_W_m2.push_back(1000);
  }
  EXPECT_EQ(KindOf(curve).kind, CurveKind::kFlash);
  for (double& time : curve.time_s) time *= 1000;
  EXPECT_EQ(KindOf(curve).kind, CurveKind::kLit);
}

TEST(CurveKindTest, OperatingPointsWanderOverHoursAndASlowSweepDoesNot) {
  RandomStream random(5);
  std::vector<double> time_s, wandering, swept, noisy;
  for (int k = 0; k < 80; ++k) {
    time_s.push_back(600.0 * k);
    wandering.push_back(600 + 20 * random.Uniform());
    swept.push_back(8.0 * k);
    noisy.push_back(8.0 * k + 2 * random.Uniform());
  }
  EXPECT_TRUE(OperatingPointsOfADay(time_s, wandering));
  EXPECT_FALSE(OperatingPointsOfADay(time_s, swept));
  EXPECT_FALSE(OperatingPointsOfADay(time_s, noisy));
  for (double& time : time_s) time /= 1000;
  EXPECT_FALSE(OperatingPointsOfADay(time_s, wandering));
  EXPECT_FALSE(OperatingPointsOfADay({}, {}));
}

TEST(CurveKindTest, KeyPointsTracesAndDarkCurvesAreToldApart) {
  IvCurve curve = SweptFrom(0, 0.57);
  for (double& current : curve.current_A) current -= 0.04;
  EXPECT_EQ(KindOf(curve).kind, CurveKind::kDark);
  curve = SweptFrom(0.4, 0.57);
  curve.suns_voc_A = 0.04;
  EXPECT_EQ(KindOf(curve).kind, CurveKind::kSunsVoc);
  curve.suns_voc_A.reset();
  curve.key_points = KeyPoints();
  EXPECT_EQ(KindOf(curve).kind, CurveKind::kIscVoc);
  curve.key_points->max_power_current_A = 0.03;
  EXPECT_EQ(KindOf(curve).kind, CurveKind::kKeyPoints);
}

}  // namespace
}  // namespace lyrefit
