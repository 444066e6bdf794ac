#include "lyrefit/study/rank_tests.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lyrefit {
namespace {

// Expected values from rank_tests_reference.py in this folder: SciPy 1.10, and enumeration of all
// signs.

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::Pointwise;

using Blocks = std::vector<std::vector<double>>;

struct ExpectedPair {
  int first, second;
  double difference, p_value, p_sidak, p_holm;
};

struct BlockCase {
  Blocks values;
  std::vector<double> mean_rank;
  double chi_square, p_value, half_width;
  std::vector<ExpectedPair> pairs;
};

const BlockCase kPlain = {{{0.91, 0.85, 0.77, 0.94, 0.60, 0.71, 0.83, 0.66, 0.79, 0.88},
                           {0.95, 0.80, 0.81, 0.97, 0.72, 0.75, 0.89, 0.70, 0.78, 0.93},
                           {0.99, 0.90, 0.79, 1.05, 0.81, 0.70, 0.95, 0.74, 0.86, 0.98}},
                          {1.3, 2.0, 2.7},
                          9.8,
                          0.0074465830709243,
                          1.06782884558841,
                          {{0, 1, -0.7, 0.1175248680966, 0.312761585025, 0.2350497361933},
                           {0, 2, -1.4, 0.001745118699529, 0.005226225095413, 0.005235356098587},
                           {1, 2, -0.7, 0.1175248680966, 0.312761585025, 0.2350497361933}}};

const BlockCase kTied = {
    {{1, 2, 2, 1, 3, 2, 1, 2},
     {2, 2, 3, 1, 3, 2, 4, 3},
     {3, 2, 4, 5, 3, 6, 4, 4},
     {3, 5, 1, 5, 3, 7, 4, 5},
     {4, 5, 6, 7, 8, 7, 9, 6}},
    {1.5625, 2.1875, 3.0625, 3.3125, 4.875},
    23.8823529411765,
    8.4330895259253e-05,
    2.04055999716755,
    {{0, 1, -0.625, 0.3911725228101, 0.9930025074478, 0.7823450456203},
     {0, 2, -1.5, 0.03959176323669, 0.3323347693832, 0.1979588161835},
     {0, 3, -1.75, 0.01635122157581, 0.1519907891619, 0.1144585510306},
     {0, 4, -3.3125, 5.501028432368e-06, 5.500892258414e-05, 5.501028432368e-05},
     {1, 2, -0.875, 0.2299490567942, 0.9266847075166, 0.6898471703826},
     {1, 3, -1.125, 0.1227125947282, 0.7299656921365, 0.4908503789127},
     {1, 4, -2.6875, 0.0002267177135359, 0.002264865491751, 0.002040459421823},
     {2, 3, -0.25, 0.7316005889599, 0.9999980599381, 0.7823450456203},
     {2, 4, -1.8125, 0.01289233899438, 0.1216952629498, 0.1031387119551},
     {3, 4, -1.5625, 0.03205434143059, 0.278045608122, 0.1923260485835}}};

const BlockCase kMostlyTied = {
    {{1, 1, 1, 1, 1, 1}, {1, 1, 2, 1, 1, 1}, {1, 1, 2, 1, 3, 1}, {1, 1, 2, 2, 3, 1}},
    {2, 7.0 / 3, 8.0 / 3, 3},
    6,
    0.111610225094713,
    1.13221860658279,
    {{0, 1, -1.0 / 3, 0.438578026081, 0.9686861518757, 1},
     {0, 2, -2.0 / 3, 0.1213352503585, 0.5398078331174, 0.6066762517924},
     {0, 3, -1, 0.02013675155035, 0.1148990358683, 0.1208205093021},
     {1, 2, -1.0 / 3, 0.438578026081, 0.9686861518757, 1},
     {1, 3, -2.0 / 3, 0.1213352503585, 0.5398078331174, 0.6066762517924},
     {2, 3, -1.0 / 3, 0.438578026081, 0.9686861518757, 1}}};

class RankTests : public ::testing::TestWithParam<const BlockCase*> {};

TEST_P(RankTests, FriedmanAgreesWithSciPy) {
  const BlockCase& expected = *GetParam();
  const Friedman friedman = FriedmanTest(expected.values);
  EXPECT_EQ(friedman.algorithms, static_cast<int>(expected.values.size()));
  EXPECT_EQ(friedman.blocks, static_cast<int>(expected.values[0].size()));
  EXPECT_THAT(friedman.mean_rank, Pointwise(DoubleNear(1e-13), expected.mean_rank));
  EXPECT_NEAR(friedman.chi_square / expected.chi_square, 1, 1e-12);
  EXPECT_NEAR(friedman.p_value / expected.p_value, 1, 1e-11);
}

TEST_P(RankTests, PairsAgreeWithDunn) {
  const BlockCase& expected = *GetParam();
  const std::vector<RankPair> pairs = ComparePairs(FriedmanTest(expected.values), expected.values);
  ASSERT_EQ(pairs.size(), expected.pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const ExpectedPair& e = expected.pairs[i];
    EXPECT_EQ(pairs[i].first, e.first);
    EXPECT_EQ(pairs[i].second, e.second);
    EXPECT_NEAR(pairs[i].difference, e.difference, 1e-13);
    EXPECT_NEAR(pairs[i].high_95 - pairs[i].difference, expected.half_width, 1e-12);
    EXPECT_NEAR(pairs[i].difference - pairs[i].low_95, expected.half_width, 1e-12);
    EXPECT_NEAR(pairs[i].p_value / e.p_value, 1, 1e-10) << i;
    EXPECT_NEAR(pairs[i].p_sidak / e.p_sidak, 1, 1e-10) << i;
    EXPECT_NEAR(pairs[i].p_holm / e.p_holm, 1, 1e-10) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Blocks, RankTests, ::testing::Values(&kPlain, &kTied, &kMostlyTied));

TEST(FriedmanTest, SaysNothingWhereAllValuesTie) {
  const Blocks values = {{1, 2}, {1, 2}, {1, 2}};
  const Friedman friedman = FriedmanTest(values);
  EXPECT_THAT(friedman.mean_rank, ElementsAre(2, 2, 2));
  EXPECT_EQ(friedman.chi_square, 0);
  EXPECT_EQ(friedman.p_value, 1);
  const std::vector<RankPair> pairs = ComparePairs(friedman, values);
  ASSERT_EQ(pairs.size(), 3U);
  for (const RankPair& pair : pairs) {
    EXPECT_EQ(pair.low_95, 0);
    EXPECT_EQ(pair.high_95, 0);
    EXPECT_EQ(pair.p_value, 1);
    EXPECT_EQ(pair.p_sidak, 1);
    EXPECT_EQ(pair.p_holm, 1);
  }
}

TEST(FriedmanTestDeathTest, WantsFiniteValuesInEqualNumbers) {
  EXPECT_DEATH(FriedmanTest({{1, 2}, {1}}), "every algorithm");
  EXPECT_DEATH(FriedmanTest({{1, 2}}), "two algorithms");
  EXPECT_DEATH(FriedmanTest({{1, NAN}, {1, 2}}), "finite");
}

// Tables 13 and 14 of J. Ind. Manag. Optim. 22(1), 642-690: 30 runs of 12 algorithms. The printed
// mean ranks are integer rank sums divided by 30.
TEST(ComparePairs, ReproducesThePublishedTable) {
  enum { kMsa, kDmo, kNna, kHts, kEvo, kGo, kKoa, kIkoa, kRmo, kIrmo, kLo, kMlo };
  const std::vector<double> printed = {4.87, 10.17, 8.60, 9.23, 9.63, 3.13,
                                       8.83, 1.90,  8.97, 5.40, 5.87, 1.40};
  Friedman friedman;
  friedman.algorithms = 12;
  friedman.blocks = 30;
  for (const double rank : printed) friedman.mean_rank.push_back(std::round(30 * rank) / 30);
  EXPECT_DOUBLE_EQ(std::accumulate(friedman.mean_rank.begin(), friedman.mean_rank.end(), 0.0), 78);
  // Only ties within the values matter, and there are none.
  Blocks values(12);
  for (int c = 0; c < 12; ++c) values[c].assign(30, c);

  const std::vector<RankPair> pairs = ComparePairs(friedman, values);
  ASSERT_EQ(pairs.size(), 66U);
  struct Published {
    int first, second;
    double low, difference, high, p, half_digit;
  };
  const Published published[] = {
      {kMsa, kNna, -6.8622, -3.7333, -0.6045, 0.004, 0.00005},
      {kMsa, kHts, -7.4955, -4.3667, -1.2378, 0.0002, 0.00005},
      {kMsa, kGo, -1.3955, 1.7333, 4.8622, 0.986, 0.00005},
      {kMsa, kIkoa, -0.1622, 2.9667, 6.0955, 0.0907, 0.00005},
      {kMsa, kMlo, 0.3378, 3.4667, 6.5955, 0.0129, 0.00005},
      {kDmo, kNna, -1.5622, 1.5667, 4.6955, 0.9983, 0.00005},
      {kNna, kLo, -0.3955, 2.7333, 5.8622, 0.1973, 0.00005},
      {kGo, kIrmo, -5.3955, -2.2667, 0.8622, 0.6287, 0.00005},
      {kRmo, kLo, -0.0288, 3.1, 6.2288, 0.0557, 0.00005},
      {kLo, kMlo, 1.3378, 4.4667, 7.5955, 0.0001, 0.00005},
  };
  for (const Published& row : published) {
    const auto found = std::find_if(pairs.begin(), pairs.end(), [&](const RankPair& pair) {
      return pair.first == row.first && pair.second == row.second;
    });
    ASSERT_NE(found, pairs.end());
    EXPECT_NEAR(found->low_95, row.low, 0.00005001);
    EXPECT_NEAR(found->difference, row.difference, 0.00005001);
    EXPECT_NEAR(found->high_95, row.high, 0.00005001);
    EXPECT_NEAR(found->p_sidak, row.p, row.half_digit) << row.first << " " << row.second;
  }
  EXPECT_NEAR(pairs[0].high_95 - pairs[0].difference, 3.1288, 0.00005);
}

struct PairCase {
  std::vector<double> first, second;
  int pairs, zeros;
  bool ties;
  double plus, minus, exact, normal;
};

TEST(WilcoxonTest, AgreesWithCountedSignsAndSciPy) {
  const PairCase cases[] = {
      {{125, 115, 130, 140, 140, 115, 140, 125, 140, 135},
       {110, 122, 127, 120, 144, 124, 123, 137, 135, 148},
       10,
       0,
       false,
       31,
       24,
       0.76953125,
       0.721276699029156},
      {{5, 7, 3, 9, 6, 8, 4, 7, 5, 6, 9, 2, 8, 7},
       {3, 7, 4, 5, 4, 6, 4, 8, 3, 4, 5, 3, 5, 7},
       11,
       3,
       true,
       60,
       6,
       0.0126953125,
       0.0150653061979048},
      {{2, 3, 4, 5, 6, 7, 8, 9, 10},
       {1, 2, 3, 4, 5, 6, 7, 8, 11},
       9,
       0,
       true,
       40,
       5,
       0.0390625,
       0.0196306572572907},
  };
  for (const PairCase& c : cases) {
    const Wilcoxon test = WilcoxonTest(c.first, c.second);
    EXPECT_EQ(test.pairs, c.pairs);
    EXPECT_EQ(test.zeros, c.zeros);
    EXPECT_EQ(test.ties, c.ties);
    EXPECT_EQ(test.rank_sum_plus, c.plus);
    EXPECT_EQ(test.rank_sum_minus, c.minus);
    EXPECT_TRUE(test.exact);
    EXPECT_NEAR(test.p_value, c.exact, 1e-15);
    EXPECT_NEAR(test.p_normal / c.normal, 1, 1e-12);
    EXPECT_EQ(test.smallest_p, std::ldexp(1, 1 - c.pairs));
  }
}

// Table 15 of J. Ind. Manag. Optim. 22(1), 642-690 prints 1.7344e-6 for nine of its eleven
// comparisons.
TEST(WilcoxonTest, ThirtyPairsOfOneSignGiveThePublishedFloor) {
  std::vector<double> worse(30);
  std::iota(worse.begin(), worse.end(), 1.0);
  const Wilcoxon test = WilcoxonTest(std::vector<double>(30, 0.5), worse);
  EXPECT_NEAR(test.p_normal, 1.7344e-6, 0.00005e-6);
  EXPECT_NEAR(test.p_normal / 1.73439762832058e-06, 1, 1e-12);
  EXPECT_EQ(test.p_value, std::ldexp(1, -29));
  EXPECT_EQ(test.smallest_p, std::ldexp(1, -29));
}

TEST(WilcoxonTest, IsNormalBeyond200Pairs) {
  std::vector<double> first;
  for (int i = 0; i < 250; ++i) first.push_back(i * 37 % 101 == 40 ? 1 : i * 37 % 101 - 40);
  const Wilcoxon test = WilcoxonTest(first, std::vector<double>(250, 0.0));
  EXPECT_FALSE(test.exact);
  EXPECT_TRUE(test.ties);
  EXPECT_EQ(test.p_value, test.p_normal);
  EXPECT_NEAR(test.p_value / 1.74928852282863e-06, 1, 1e-10);
}

TEST(WilcoxonTest, IsExactAndNearlyNormalAt200Pairs) {
  std::vector<double> first;
  for (int i = 0; i < 200; ++i) first.push_back(i * 37 % 101 - 45.5);
  const Wilcoxon test = WilcoxonTest(first, std::vector<double>(200, 0.0));
  EXPECT_TRUE(test.exact);
  EXPECT_LT(test.p_value, 0.1);
  EXPECT_NEAR(test.p_value / test.p_normal, 1, 0.02);
}

TEST(WilcoxonTest, SaysNothingWithoutDifferences) {
  const Wilcoxon test = WilcoxonTest({1, 2, 3}, {1, 2, 3});
  EXPECT_EQ(test.pairs, 0);
  EXPECT_EQ(test.zeros, 3);
  EXPECT_EQ(test.p_value, 1);
  EXPECT_EQ(test.p_normal, 1);
  EXPECT_EQ(test.smallest_p, 1);
  EXPECT_EQ(WilcoxonTest({1, 2}, {2, 2}).p_value, 1);
}

TEST(HolmCorrection, NeverFallsAlongTheOrder) {
  // Expected values from R's p.adjust.
  EXPECT_THAT(HolmCorrection({0.01, 0.04, 0.03, 0.04, 0.2, 1e-5}),
              Pointwise(DoubleNear(1e-15), {0.05, 0.12, 0.12, 0.12, 0.2, 6e-5}));
  EXPECT_THAT(HolmCorrection({0.9, 0.8}), ElementsAre(1, 1));
  EXPECT_TRUE(HolmCorrection({}).empty());
}

TEST(JoinEqual, ReplacesChainsByTheirSmallest) {
  EXPECT_THAT(JoinEqual({3, 1.0 + 1e-10, 1, 1.0 + 2e-10, 2}, 1.5e-10), ElementsAre(3, 1, 1, 1, 2));
  EXPECT_THAT(JoinEqual({1, 1 + 1e-8}, 1e-9), ElementsAre(1, 1 + 1e-8));
  EXPECT_THAT(JoinEqual({0, 0, -1}, 1e-9), ElementsAre(0, 0, -1));
  EXPECT_TRUE(JoinEqual({}, 1e-9).empty());
}

}  // namespace
}  // namespace lyrefit
