#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "lyrefit/search/run.h"

namespace lyrefit {

// Candidates sorted by rising objective value, so that drawing a candidate better than i needs no
// scan.
class CandidateOrder {
 public:
  explicit CandidateOrder(const SearchRun& run)
      : run_(run), order_(run.population()), rank_(order_.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    std::stable_sort(order_.begin(), order_.end(),
                     [&](int a, int b) { return run.f(a) < run.f(b); });
    for (std::size_t r = 0; r < order_.size(); ++r) rank_[order_[r]] = static_cast<int>(r);
  }

  // Number of strictly better candidates. They have the ranks 0 .. count - 1 and form the safe set
  // S_i of Eq. 18.
  int Better(int candidate) const {
    int count = rank_[candidate];
    while (count > 0 && run_.f(order_[count - 1]) == run_.f(candidate)) --count;
    return count;
  }
  int At(int rank) const { return order_[rank]; }

  // Restores the order after the objective value of `candidate` has fallen.
  void Improved(int candidate) {
    int r = rank_[candidate];
    for (; r > 0 && run_.f(order_[r - 1]) > run_.f(candidate); --r) {
      order_[r] = order_[r - 1];
      rank_[order_[r]] = r;
    }
    order_[r] = candidate;
    rank_[candidate] = r;
  }

 private:
  const SearchRun& run_;
  std::vector<int> order_;
  std::vector<int> rank_;
};

}  // namespace lyrefit
