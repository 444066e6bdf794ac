#include <gtest/gtest.h>

#include "trend/years_weather.h"

namespace years {
namespace {

double MeanClearness(const Measured& measured, Sky sky) {
  double sum = 0, minutes = 0;
  for (const Stretch& stretch : measured.stretches) {
    if (stretch.sky != sky) continue;
    for (const double clearness : stretch.clearness) {
      sum += stretch.minutes * clearness;
      minutes += stretch.minutes;
    }
  }
  return sum / minutes;
}

TEST(YearsField, ShortTableIsLikeTheMeasuredDays) {
  std::string error;
  const Measured full = FromFolder(LYREFIT_FIELD_DATA_DIR, &error), table = BuiltIn();
  ASSERT_EQ(error, "");
  for (const Sky sky : {Sky::kClear, Sky::kBroken, Sky::kOvercast}) {
    EXPECT_NEAR(MeanClearness(full, sky), MeanClearness(table, sky), 0.04);
  }
  EXPECT_NEAR(full.rise_K, table.rise_K, 0.1);
  EXPECT_NEAR(full.scatter_K, table.scatter_K, 0.5);
}

}  // namespace
}  // namespace years
