#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "lyrefit/search/run.h"

namespace lyrefit {

// Birds by rising objective value, so that "a random bird better than i" needs no scan.
class BirdOrder {
 public:
  explicit BirdOrder(const SearchRun& run)
      : run_(run), order_(run.population()), rank_(order_.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    std::stable_sort(order_.begin(), order_.end(),
                     [&](int a, int b) { return run.f(a) < run.f(b); });
    for (std::size_t r = 0; r < order_.size(); ++r) rank_[order_[r]] = static_cast<int>(r);
  }

  // How many birds are strictly better: they are order_[0 .. count - 1], the safe set S_i of
  // Eq. 18.
  int Better(int bird) const {
    int count = rank_[bird];
    while (count > 0 && run_.f(order_[count - 1]) == run_.f(bird)) --count;
    return count;
  }
  int At(int rank) const { return order_[rank]; }

  // Bird has become better: let it rise to its place.
  void Improved(int bird) {
    int r = rank_[bird];
    for (; r > 0 && run_.f(order_[r - 1]) > run_.f(bird); --r) {
      order_[r] = order_[r - 1];
      rank_[order_[r]] = r;
    }
    order_[r] = bird;
    rank_[bird] = r;
  }

 private:
  const SearchRun& run_;
  std::vector<int> order_;
  std::vector<int> rank_;
};

}  // namespace lyrefit
