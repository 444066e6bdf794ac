#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "lyrefit/base/numbers.h"

namespace lyrefit {

// Median of |deviation| of any number of values in constant memory. Bins begin at kSmallest and
// grow by the factor kStep.
class DeviationBins {
 public:
  void Add(double deviation) {
    const double size = std::max(std::fabs(deviation), kSmallest);
    const double bin = std::floor(std::log(size / kSmallest) / std::log(kStep));
    ++bins_[static_cast<std::size_t>(std::min(bin, kBins - 1.0))];
    ++count_;
  }
  std::int64_t count() const { return count_; }
  // Unknown without values.
  double Median() const {
    if (count_ == 0) return kUnknown;
    std::int64_t below = 0;
    std::size_t bin = 0;
    while (2 * (below += bins_[bin]) < count_) ++bin;
    return kSmallest * std::pow(kStep, static_cast<double>(bin) + 0.5);
  }

 private:
  static constexpr double kSmallest = 1e-7;
  static constexpr double kStep = 1.01;
  static constexpr int kBins = 2000;  // up to |deviation| = 40
  std::vector<std::int64_t> bins_ = std::vector<std::int64_t>(kBins);
  std::int64_t count_ = 0;
};

}  // namespace lyrefit
