#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Rank statistics of repeated runs. A block is what all algorithms share (one seed, one curve); in
// a block the smallest value ranks first and equal values share the mean of their ranks. Values
// must be finite (CHECKed).

// Replaces each value by the smallest of its group, where a group is a chain of sorted values no
// two neighbours of which differ by more than `relative` of themselves: answers that agree to
// rounding are equal, not better or worse.
std::vector<double> JoinEqual(std::vector<double> values, double relative);

// Friedman's test (1937, doi:10.1080/01621459.1937.10503522) that all algorithms rank alike, with
// the correction for ties. `values[c][b]` is compared c in block b; at least two algorithms and
// one block (CHECKed).
struct Friedman {
  int algorithms = 0;             // that were ranked
  int blocks = 0;                 // in which they were
  std::vector<double> mean_rank;  // of each compared
  double chi_square = 0;          // the statistic
  double p_value = 1;  // chi-square with algorithms - 1 degrees of freedom; 1 if all values tie
};
Friedman FriedmanTest(const std::vector<std::vector<double>>& values);

// One pair after Friedman: difference of mean ranks against the normal distribution (Dunn 1964,
// doi:10.1080/00401706.1964.10490181), with the tie-corrected variance of the ranks. `values` are
// those of the test: their ties enter the variance.
struct RankPair {
  int first = 0;          // position among the algorithms
  int second = 0;         // the same
  double difference = 0;  // mean rank of first - second
  double low_95 = 0;      // simultaneous 95 % interval (Sidak over all pairs)
  double high_95 = 0;
  double p_value = 1;  // of this pair alone, two-sided
  double p_sidak = 1;  // 1 - (1 - p)^pairs
  double p_holm = 1;   // Holm's step-down over all pairs
};
std::vector<RankPair> ComparePairs(const Friedman& friedman,
                                   const std::vector<std::vector<double>>& values);

// Wilcoxon's signed-rank test (1945, doi:10.2307/3001968), two-sided, of paired values. Zero
// differences are left out. The p-value is exact (the distribution over all signs, given the ranks,
// ties included) up to 200 pairs, beyond that normal with the variance corrected for ties.
struct Wilcoxon {
  int pairs = 0;              // with a difference
  int zeros = 0;              // left out
  bool ties = false;          // some differences are of one size
  double rank_sum_plus = 0;   // ranks of the pairs with first > second
  double rank_sum_minus = 0;  // those with first < second
  double p_value = 1;         // two-sided
  double p_normal = 1;        // normal approximation, tie-corrected, no continuity correction
  bool exact = true;          // how p_value was found
  double smallest_p = 1;      // the smallest p that so many pairs allow: 2^(1 - pairs)
};
Wilcoxon WilcoxonTest(const std::vector<double>& first, const std::vector<double>& second);

// Holm's correction (1979, jstor:4615733): as many p-values, in the same order.
std::vector<double> HolmCorrection(const std::vector<double>& p_values);

}  // namespace lyrefit
