#include "lyrefit/fleet/sketch.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lyrefit {
namespace {

TEST(Sketch, ReadsBackWithinHalfAStep) {
  std::vector<double> voltage_V, current_A;
  for (int i = 0; i <= 40; ++i) {
    voltage_V.push_back(40 - i);  // downwards
    current_A.push_back(8 * (1 - std::pow((40.0 - i) / 40, 9)));
  }
  const std::string text = Sketch(voltage_V, current_A, 40);
  EXPECT_EQ(text.size(), 32U);
  const std::vector<double> parts = ReadSketch(text);
  ASSERT_EQ(parts.size(), static_cast<std::size_t>(kSketchPoints));
  for (int i = 0; i < kSketchPoints; ++i) {
    const double v = static_cast<double>(i) / (kSketchPoints - 1);
    EXPECT_NEAR(parts[i], 1 - std::pow(v, 9), 0.5 / 255 + 0.012) << i;  // and the readings' steps
  }
}

TEST(Sketch, OfNothingIsNothing) {
  EXPECT_EQ(Sketch({}, {}, 40), "");
  EXPECT_EQ(Sketch({0, 1, 2}, {-1, -1, -1}, 40), "");
  EXPECT_TRUE(ReadSketch("no sketch").empty());
}

}  // namespace
}  // namespace lyrefit
