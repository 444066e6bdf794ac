#include "lyrefit/search/run.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "lyrefit/base/random.h"
#include "repeats.h"

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
  constexpr int kCandidates = 13, kDimensions = 5;
  RandomStream random(4);
  std::vector<double> unit(kCandidates * kDimensions);
  for (double& x : unit) x = random.Uniform();
  Crowding crowding(kCandidates, kDimensions, unit);
  for (int move = 0; move < 2000; ++move) {
    const int candidate = static_cast<int>(random.Index(kCandidates));
    for (int j = 0; j < kDimensions; ++j) unit[candidate * kDimensions + j] = random.Uniform();
    crowding.Move(candidate, &unit[candidate * kDimensions]);
    double largest = 0;
    for (int a = 0; a < kCandidates; ++a) {
      double sum = 0;
      for (int b = 0; b < kCandidates; ++b) sum += Distance(unit, kDimensions, a, b);
      EXPECT_NEAR(crowding.MeanDistance(a), sum / (kCandidates - 1), 1e-12);
      for (int b = 0; b < a; ++b) largest = std::max(largest, Distance(unit, kDimensions, a, b));
    }
    ASSERT_NEAR(crowding.LargestDistance(), largest, 1e-15) << "move " << move;
  }
}

TEST(Crowding, FindsTheLargestDistanceOfManyCandidatesInLittleMemory) {
  SKIP_IF_SANITIZED();
  constexpr int kCandidates = 20000;
  RandomStream random(5);
  std::vector<double> unit(kCandidates);
  for (double& x : unit) x = random.Uniform();
  // A table of all distances would take 3.2 GB.
  const auto in_little_memory = [&] {
    const rlimit limit = {1U << 30, 1U << 30};
    if (setrlimit(RLIMIT_AS, &limit) != 0) std::_Exit(1);
    Crowding crowding(kCandidates, 1, unit);
    const auto largest = [&] {
      const auto ends = std::minmax_element(unit.begin(), unit.end());
      return *ends.second - *ends.first;
    };
    if (crowding.LargestDistance() != largest()) std::_Exit(2);
    for (int move = 0; move < 20; ++move) {  // moves the outermost candidate to the middle
      const auto end = std::max_element(unit.begin(), unit.end());
      *end = 0.5;
      crowding.Move(static_cast<int>(end - unit.begin()), &*end);
      if (crowding.LargestDistance() != largest()) std::_Exit(3);
    }
    std::_Exit(0);
  };
  EXPECT_EXIT(in_little_memory(), ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace lyrefit
