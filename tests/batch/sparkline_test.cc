#include "lyrefit/batch/sparkline.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lyrefit {
namespace {

TEST(Sparkline, ReadsBackWithinHalfAStep) {
  std::vector<double> voltage_V, current_A;
  for (int i = 0; i <= 40; ++i) {
    voltage_V.push_back(40 - i);  // falling voltage
    current_A.push_back(8 * (1 - std::pow((40.0 - i) / 40, 9)));
  }
  const std::string text = Sparkline(voltage_V, current_A, 40);
  EXPECT_EQ(text.size(), 32U);
  const std::vector<double> parts = ReadSparkline(text);
  ASSERT_EQ(parts.size(), static_cast<std::size_t>(kSparklinePoints));
  for (int i = 0; i < kSparklinePoints; ++i) {
    const double v = static_cast<double>(i) / (kSparklinePoints - 1);
    // The tolerance includes the interpolation error between readings.
    EXPECT_NEAR(parts[i], 1 - std::pow(v, 9), 0.5 / 255 + 0.012) << i;
  }
}

TEST(Sparkline, OfNothingIsNothing) {
  EXPECT_EQ(Sparkline({}, {}, 40), "");
  EXPECT_EQ(Sparkline({0, 1, 2}, {-1, -1, -1}, 40), "");
  EXPECT_TRUE(ReadSparkline("no sparkline").empty());
}

}  // namespace
}  // namespace lyrefit
