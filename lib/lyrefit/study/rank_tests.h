// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Rank statistics of repeated runs. A block is a condition that all algorithms share (one seed, one
// curve). In a block the smallest value has rank 1, and equal values share the mean of their ranks.
// Values must be finite (CHECKed).

// Replaces each value by the smallest of its group. A group is a chain of sorted values in which
// neighbours differ by at most `relative` of their size. Values that agree to rounding thus become
// ties.
std::vector<double> JoinEqual(std::vector<double> values, double relative);

// Friedman's test (1937, doi:10.1080/01621459.1937.10503522) of the hypothesis that all algorithms
// rank alike, with the correction for ties. `values[c][b]` is the value of algorithm c in block b.
// At least two algorithms and one block are required (CHECKed).
struct Friedman {
  int algorithms = 0;             // number of ranked algorithms
  int blocks = 0;                 // number of blocks
  std::vector<double> mean_rank;  // of each algorithm
  double chi_square = 0;          // the statistic
  double p_value = 1;  // chi-square with algorithms - 1 degrees of freedom; 1 if all values tie
};
Friedman FriedmanTest(const std::vector<std::vector<double>>& values);

// Comparison of one pair after Friedman's test. The difference of mean ranks is tested against the
// normal distribution (Dunn 1964, doi:10.1080/00401706.1964.10490181), with the tie-corrected
// variance of the ranks. `values` must be those of the Friedman test, since their ties enter the
// variance.
struct RankPair {
  int first = 0;          // position among the algorithms
  int second = 0;         // position among the algorithms
  double difference = 0;  // mean rank of first - second
  double low_95 = 0;      // simultaneous 95 % interval (Sidak over all pairs)
  double high_95 = 0;
  double p_value = 1;  // two-sided, not corrected for multiple pairs
  double p_sidak = 1;  // 1 - (1 - p)^pairs
  double p_holm = 1;   // Holm's step-down over all pairs
};
std::vector<RankPair> ComparePairs(const Friedman& friedman,
                                   const std::vector<std::vector<double>>& values);

// Wilcoxon's signed-rank test (1945, doi:10.2307/3001968), two-sided, of paired values. Zero
// differences are left out. Up to 200 pairs the p-value is exact: the distribution over all signs,
// given the ranks, ties included. Beyond 200 pairs it is normal with the variance corrected for
// ties.
struct Wilcoxon {
  int pairs = 0;              // number of pairs with a non-zero difference
  int zeros = 0;              // number of pairs with a zero difference
  bool ties = false;          // some differences have equal absolute values
  double rank_sum_plus = 0;   // ranks of the pairs with first > second
  double rank_sum_minus = 0;  // ranks of the pairs with first < second
  double p_value = 1;         // two-sided
  double p_normal = 1;        // normal approximation, tie-corrected, no continuity correction
  bool exact = true;          // true: p_value is exact
  double smallest_p = 1;      // smallest possible p for this number of pairs: 2^(1 - pairs)
};
Wilcoxon WilcoxonTest(const std::vector<double>& first, const std::vector<double>& second);

// Holm's correction (1979, jstor:4615733). Returns the corrected p-values in the order of
// `p_values`.
std::vector<double> HolmCorrection(const std::vector<double>& p_values);

}  // namespace lyrefit
