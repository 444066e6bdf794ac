#include "lyrefit/diagnose/measurement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.h"
#include "synthetic/curves.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

TEST(MakeMeasurementTest, HoldsWhatIsDiagnosed) {
  IvCurve curve = SyntheticCurve({});
  for (double& i : curve.current_A) i = std::min(i, 7.95);
  curve.notes.current_noise_constant_A = 0.004;
  const auto measurement = MakeMeasurement(SetOf({curve}));
  ASSERT_TRUE(measurement);
  EXPECT_EQ(measurement->readings.points.size(), curve.size());
  EXPECT_EQ(measurement->notes.current_noise_constant_A, 0.004);
  EXPECT_GT(measurement->values.clip_level, 0);
  EXPECT_EQ(measurement->values.rounding.size(), curve.size());
}

TEST(MakeMeasurementTest, RefusesWhatCannotBeDiagnosed) {
  EXPECT_FALSE(MakeMeasurement(CurveSet()));
  Recipe few;
  few.points = 6;
  EXPECT_THAT(MessageOf(MakeMeasurement(SetOf({SyntheticCurve(few)}))),
              HasSubstr("7 readings or more, there are 6"));
  few.points = 7;
  EXPECT_TRUE(MakeMeasurement(SetOf({SyntheticCurve(few)})));
}

}  // namespace
}  // namespace lyrefit
