#include "lyrefit/base/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace lyrefit {
namespace {

TEST(RandomStreamTest, SameSeedAndRunGiveTheSameStream) {
  RandomStream a(7, 3);
  RandomStream b(7, 3);
  for (int i = 0; i < 1000; ++i) {
    ASSERT_EQ(a.Bits(), b.Bits());
    ASSERT_EQ(a.Normal(), b.Normal());
  }
}

TEST(RandomStreamTest, NeighbouringSeedsAndRunsDiffer) {
  const std::uint64_t first = RandomStream(1, 0).Bits();
  EXPECT_NE(first, RandomStream(2, 0).Bits());
  EXPECT_NE(first, RandomStream(1, 1).Bits());
  EXPECT_NE(RandomStream(1, 1).Bits(), RandomStream(2, 0).Bits());
}

TEST(RandomStreamTest, FirstBitsAreTheSameOnEveryMachine) {
  RandomStream random(1);
  EXPECT_EQ(random.Bits(), 8770077814761700327ULL);
  EXPECT_EQ(random.Bits(), 4154907570581360111ULL);
  EXPECT_EQ(random.Uniform(), 0x1.55834f9acbc6cp-2);
}

TEST(RandomStreamTest, UniformFillsTheHalfOpenUnitInterval) {
  RandomStream random(11);
  double sum = 0;
  double square = 0;
  constexpr int kDraws = 100000;
  for (int i = 0; i < kDraws; ++i) {
    const double value = random.Uniform();
    ASSERT_GE(value, 0);
    ASSERT_LT(value, 1);
    sum += value;
    square += value * value;
  }
  EXPECT_NEAR(sum / kDraws, 0.5, 0.005);
  EXPECT_NEAR(square / kDraws, 1.0 / 3, 0.005);
}

TEST(RandomStreamTest, IndexReachesEveryValueAboutEquallyOften) {
  RandomStream random(12);
  constexpr int kDraws = 70000;
  std::vector<int> count(7);
  for (int i = 0; i < kDraws; ++i) {
    const std::uint32_t index = random.Index(7);
    ASSERT_LT(index, 7U);
    ++count[index];
  }
  for (const int drawn : count) EXPECT_NEAR(drawn, 10000, 500);
  EXPECT_EQ(random.Index(1), 0U);
}

TEST(RandomStreamTest, NormalHasTheMomentsOfTheStandardNormal) {
  RandomStream random(13);
  double sum = 0;
  double square = 0;
  double fourth = 0;
  int beyond_two = 0;
  constexpr int kDraws = 100000;
  for (int i = 0; i < kDraws; ++i) {
    const double value = random.Normal();
    sum += value;
    square += value * value;
    fourth += std::pow(value, 4);
    if (std::abs(value) > 2) ++beyond_two;
  }
  EXPECT_NEAR(sum / kDraws, 0, 0.015);
  EXPECT_NEAR(square / kDraws, 1, 0.02);
  EXPECT_NEAR(fourth / kDraws, 3, 0.15);
  EXPECT_NEAR(beyond_two / static_cast<double>(kDraws), 0.0455, 0.003);
}

}  // namespace
}  // namespace lyrefit
