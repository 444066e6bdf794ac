#include "lyrefit/search/crowding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/random.h"

namespace lyrefit {
namespace {

double Distance(const std::vector<double>& unit, int d, int a, int b) {
  double sum = 0;
  for (int j = 0; j < d; ++j) {
    const double step = unit[a * d + j] - unit[b * d + j];
    sum += step * step;
  }
  return std::sqrt(sum);
}

TEST(Crowding, AgreesWithThePlainDefinitionAfterManyMoves) {
  constexpr int kBirds = 13, kDimensions = 5;
  RandomStream random(4);
  std::vector<double> unit(kBirds * kDimensions);
  for (double& x : unit) x = random.Uniform();
  Crowding crowding(kBirds, kDimensions, unit);
  for (int move = 0; move < 2000; ++move) {
    const int bird = static_cast<int>(random.Index(kBirds));
    for (int j = 0; j < kDimensions; ++j) unit[bird * kDimensions + j] = random.Uniform();
    crowding.Move(bird, &unit[bird * kDimensions]);
    double largest = 0;
    for (int a = 0; a < kBirds; ++a) {
      double sum = 0;
      for (int b = 0; b < kBirds; ++b) sum += Distance(unit, kDimensions, a, b);
      EXPECT_NEAR(crowding.MeanDistance(a), sum / (kBirds - 1), 1e-12);
      for (int b = 0; b < a; ++b) largest = std::max(largest, Distance(unit, kDimensions, a, b));
    }
    ASSERT_NEAR(crowding.LargestDistance(), largest, 1e-15) << "move " << move;
  }
}

}  // namespace
}  // namespace lyrefit
