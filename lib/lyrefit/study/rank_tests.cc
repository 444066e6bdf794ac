#include "lyrefit/study/rank_tests.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lyrefit/base/distributions.h"

namespace lyrefit {
namespace {

constexpr int kMostExactPairs = 200;

double TwoSidedNormal(double z) { return std::min(1.0, 2 * NormalTail(std::fabs(z))); }

std::vector<std::size_t> OrderOf(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  return order;
}

// Ranks from 1, doubled so that the mean rank of a tie is an integer too.
struct DoubledRanks {
  std::vector<int> rank;
  double tie_sum = 0;  // sum of t^3 - t over the groups of t equal values
};

DoubledRanks RankDoubled(const std::vector<double>& values) {
  const std::vector<std::size_t> order = OrderOf(values);
  DoubledRanks ranks;
  ranks.rank.resize(values.size());
  std::size_t begin = 0;
  while (begin < order.size()) {
    std::size_t end = begin + 1;
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    for (std::size_t i = begin; i < end; ++i) {
      ranks.rank[order[i]] = static_cast<int>(begin + end + 1);
    }
    const auto tied = static_cast<double>(end - begin);
    ranks.tie_sum += tied * tied * tied - tied;
    begin = end;
  }
  return ranks;
}

void CheckBlocks(const std::vector<std::vector<double>>& values) {
  CHECK_GE(values.size(), 2U) << "ranks need two algorithms";
  CHECK(!values[0].empty()) << "ranks need a block";
  for (const std::vector<double>& of_algorithm : values) {
    CHECK_EQ(of_algorithm.size(), values[0].size())
        << "every algorithm needs a value in every block";
    for (const double value : of_algorithm) CHECK(std::isfinite(value));
  }
}

// Doubled ranks within block `b`.
DoubledRanks RankBlock(const std::vector<std::vector<double>>& values, std::size_t b) {
  std::vector<double> block;
  block.reserve(values.size());
  for (const std::vector<double>& of_algorithm : values) block.push_back(of_algorithm[b]);
  return RankDoubled(block);
}

// Half the variance of the difference of two algorithms' ranks in a block, if all orders are
// equally likely. Without ties it is k (k + 1) / 12, with ties the mean over the blocks.
double RankVariance(const std::vector<std::vector<double>>& values) {
  const auto k = static_cast<double>(values.size());
  const auto blocks = static_cast<double>(values[0].size());
  double tie_sum = 0;
  for (std::size_t b = 0; b < values[0].size(); ++b) tie_sum += RankBlock(values, b).tie_sum;
  return (k * (k + 1) - tie_sum / blocks / (k - 1)) / 12;
}

// P(sum of the ranks of the positive differences <= doubled_sum / 2), if both signs are equally
// likely. The distribution is built up one difference at a time.
double SignedRankTail(const std::vector<int>& doubled_ranks, int doubled_sum) {
  // Rank sums above `doubled_sum` cannot decrease and are dropped.
  std::vector<double> probability(static_cast<std::size_t>(doubled_sum) + 1, 0.0);
  probability[0] = 1;
  for (const int rank : doubled_ranks) {
    for (int s = doubled_sum; s >= 0; --s) {
      probability[s] = 0.5 * (probability[s] + (s >= rank ? probability[s - rank] : 0.0));
    }
  }
  return std::accumulate(probability.begin(), probability.end(), 0.0);
}

}  // namespace

std::vector<double> JoinEqual(std::vector<double> values, double relative) {
  for (const double value : values) CHECK(std::isfinite(value));
  CHECK_GE(relative, 0);
  const std::vector<std::size_t> order = OrderOf(values);
  double smallest = 0;  // smallest value of the current group
  double previous = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double value = values[order[i]];
    const double size = std::max(std::fabs(value), std::fabs(previous));
    if (i == 0 || value - previous > relative * size) smallest = value;
    values[order[i]] = smallest;
    previous = value;
  }
  return values;
}

Friedman FriedmanTest(const std::vector<std::vector<double>>& values) {
  CheckBlocks(values);
  Friedman friedman;
  friedman.algorithms = static_cast<int>(values.size());
  friedman.blocks = static_cast<int>(values[0].size());
  std::vector<double> rank_sum(values.size(), 0.0);
  for (std::size_t b = 0; b < values[0].size(); ++b) {
    const DoubledRanks ranks = RankBlock(values, b);
    for (std::size_t c = 0; c < values.size(); ++c) rank_sum[c] += 0.5 * ranks.rank[c];
  }
  const double expected = 0.5 * (friedman.algorithms + 1);
  double squares = 0;
  for (const double sum : rank_sum) {
    friedman.mean_rank.push_back(sum / friedman.blocks);
    squares += std::pow(friedman.mean_rank.back() - expected, 2);
  }
  const double variance = RankVariance(values);
  if (!(variance > 0)) return friedman;
  friedman.chi_square = friedman.blocks * squares / variance;
  friedman.p_value = ChiSquaredTail(friedman.chi_square, friedman.algorithms - 1);
  return friedman;
}

std::vector<RankPair> ComparePairs(const Friedman& friedman,
                                   const std::vector<std::vector<double>>& values) {
  CheckBlocks(values);
  CHECK_EQ(friedman.mean_rank.size(), values.size());
  CHECK_EQ(static_cast<std::size_t>(friedman.blocks), values[0].size());
  const int algorithms = friedman.algorithms;
  const double count = 0.5 * algorithms * (algorithms - 1);
  const double deviation = std::sqrt(2 * RankVariance(values) / friedman.blocks);
  // Sidak: 1 - (1 - each)^count = 0.05.
  const double each = -std::expm1(std::log1p(-0.05) / count);
  const double z_95 = NormalAbove(each / 2);
  std::vector<RankPair> pairs;
  std::vector<double> p_values;
  for (int a = 0; a < algorithms; ++a) {
    for (int b = a + 1; b < algorithms; ++b) {
      RankPair pair;
      pair.first = a;
      pair.second = b;
      pair.difference = friedman.mean_rank[a] - friedman.mean_rank[b];
      pair.low_95 = pair.difference - z_95 * deviation;
      pair.high_95 = pair.difference + z_95 * deviation;
      if (deviation > 0) pair.p_value = TwoSidedNormal(pair.difference / deviation);
      pair.p_sidak = pair.p_value < 1 ? -std::expm1(count * std::log1p(-pair.p_value)) : 1.0;
      pairs.push_back(pair);
      p_values.push_back(pair.p_value);
    }
  }
  const std::vector<double> holm = HolmCorrection(p_values);
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i].p_holm = holm[i];
  return pairs;
}

Wilcoxon WilcoxonTest(const std::vector<double>& first, const std::vector<double>& second) {
  CHECK_EQ(first.size(), second.size()) << "values must come in pairs";
  Wilcoxon test;
  std::vector<double> size;
  std::vector<bool> positive;
  for (std::size_t i = 0; i < first.size(); ++i) {
    CHECK(std::isfinite(first[i]) && std::isfinite(second[i]));
    if (first[i] == second[i]) {
      ++test.zeros;
      continue;
    }
    size.push_back(std::fabs(first[i] - second[i]));
    positive.push_back(first[i] > second[i]);
  }
  test.pairs = static_cast<int>(size.size());
  test.exact = test.pairs <= kMostExactPairs;
  if (test.pairs == 0) return test;

  const DoubledRanks ranks = RankDoubled(size);
  test.ties = ranks.tie_sum > 0;
  int plus = 0;
  int minus = 0;
  for (std::size_t i = 0; i < size.size(); ++i) (positive[i] ? plus : minus) += ranks.rank[i];
  test.rank_sum_plus = 0.5 * plus;
  test.rank_sum_minus = 0.5 * minus;
  const double n = test.pairs;
  const double variance = n * (n + 1) * (2 * n + 1) / 24 - ranks.tie_sum / 48;
  test.p_normal = TwoSidedNormal((test.rank_sum_plus - n * (n + 1) / 4) / std::sqrt(variance));
  test.smallest_p = std::ldexp(1.0, 1 - test.pairs);
  test.p_value = test.exact ? std::min(1.0, 2 * SignedRankTail(ranks.rank, std::min(plus, minus)))
                            : test.p_normal;
  return test;
}

std::vector<double> HolmCorrection(const std::vector<double>& p_values) {
  std::vector<double> corrected(p_values.size());
  double largest = 0;
  auto left = static_cast<double>(p_values.size());
  for (const std::size_t i : OrderOf(p_values)) {
    largest = std::max(largest, std::min(1.0, left * p_values[i]));
    corrected[i] = largest;
    left -= 1;
  }
  return corrected;
}

}  // namespace lyrefit
