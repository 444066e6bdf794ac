#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "lyrefit/base/distributions.h"

namespace lyrefit {

constexpr double kTail = 0.02;  // below it p-values follow the F distribution's tail

inline double TailOf(double statistic, int degrees) {
  if (!(statistic > 0)) return 1;
  return std::max(FisherTail(statistic, 1, std::max(degrees, 1)), 1e-300);
}

// p-value of a statistic given the sorted (falling) statistics of the nulls.
class NullLaw {
 public:
  NullLaw(Eigen::VectorXd nulls, int degrees) : nulls_(std::move(nulls)), degrees_(degrees) {
    std::sort(nulls_.begin(), nulls_.end(), std::greater<double>());
    edge_ = static_cast<int>(kTail * static_cast<double>(nulls_.size()));
    edge_tail_ = TailOf(nulls_[edge_], degrees_);
  }
  double Of(double statistic) const {
    if (statistic > nulls_[edge_]) return kTail * TailOf(statistic, degrees_) / edge_tail_;
    const auto above =
        std::upper_bound(nulls_.begin(), nulls_.end(), statistic, std::greater<double>()) -
        nulls_.begin();
    return std::max(kTail, static_cast<double>(above) / static_cast<double>(nulls_.size()));
  }
  // How many independent directions would give such nulls.
  double Directions() const { return std::max(kTail / edge_tail_, 0.5); }

 private:
  Eigen::VectorXd nulls_;
  int degrees_;
  int edge_;
  double edge_tail_;
};

// The whole list under its nulls.
struct ListLaw {
  std::vector<NullLaw> laws;  // of the testable candidates, in order
  Eigen::VectorXd smallest;   // rising: the smallest p-value of each null
  int edge = 0;

  double Catalogue() const { return std::max(1.0, kTail / smallest[edge]); }
  double Corrected(double p) const {
    if (p < smallest[edge]) return std::max(p, kTail * p / smallest[edge]);
    const auto below = std::upper_bound(smallest.begin(), smallest.end(), p) - smallest.begin();
    return std::max(p, static_cast<double>(below) / static_cast<double>(smallest.size()));
  }
};

}  // namespace lyrefit
