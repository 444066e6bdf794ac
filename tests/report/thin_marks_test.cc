#include "lyrefit/report/figure_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lyrefit {
namespace {

using ::testing::Contains;

TEST(MarksToDraw, AreAllOfFewPoints) {
  EXPECT_EQ(MarksToDraw({3, 1, 2}, {0, 0, 0}, 10), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_TRUE(MarksToDraw({}, {}, 10).empty());
}

TEST(MarksToDraw, KeepTheExtremesAndTheEnds) {
  std::vector<double> x(100000), y(100000);
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = 1e-3 * static_cast<double>(i);
    y[i] = std::sin(x[i]);
  }
  y[31417] = 7;   // one outlier up
  y[70001] = -9;  // and one down
  const std::vector<std::size_t> kept = MarksToDraw(x, y);
  EXPECT_LE(kept.size(), kMostMarks + 4);
  EXPECT_GT(kept.size(), kMostMarks / 3);
  for (const std::size_t i : {0, 31417, 70001, 99999}) EXPECT_THAT(kept, Contains(i));
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  // No visible gap: 0.3 of an axis of 100.
  for (std::size_t k = 1; k < kept.size(); ++k) EXPECT_LT(x[kept[k]] - x[kept[k - 1]], 0.3);
}

TEST(MarksToDraw, LeaveOutWhatIsNotFinite) {
  std::vector<double> x(5000), y(5000, 1.0);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = static_cast<double>(i);
  y[17] = std::numeric_limits<double>::quiet_NaN();
  x[18] = std::numeric_limits<double>::infinity();
  const std::vector<std::size_t> kept = MarksToDraw(x, y, 100);
  EXPECT_LE(kept.size(), 104U);
  for (const std::size_t i : kept) EXPECT_TRUE(i != 17 && i != 18);
}

// Keeping only the extremes would exaggerate the spread.
TEST(MarksToDraw, ShowWhatIsUsualToo) {
  std::vector<double> x(50000), y(50000);
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = static_cast<double>(i);
    y[i] = static_cast<double>((i * 7919) % 1000);  // evenly between 0 and 1000
  }
  const std::vector<std::size_t> kept = MarksToDraw(x, y);
  const auto usual =
      std::count_if(kept.begin(), kept.end(), [&](auto i) { return y[i] > 200 && y[i] < 800; });
  EXPECT_GT(usual, static_cast<long>(kept.size()) / 5);
}

TEST(MarksToDraw, OfOneVoltageAreItsLowestAndHighest) {
  std::vector<double> x(5000, 2.0), y(5000);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = static_cast<double>((i * 7919) % 5000);
  const std::vector<std::size_t> kept = MarksToDraw(x, y, 100);
  ASSERT_LE(kept.size(), 6U);
  double low = 1e9, high = -1e9;
  for (const std::size_t i : kept) low = std::min(low, y[i]), high = std::max(high, y[i]);
  EXPECT_EQ(low, 0);
  EXPECT_EQ(high, 4999);
}

}  // namespace
}  // namespace lyrefit
