#include "lyrefit/diagnose/null_distribution.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>

#include "lyrefit/base/distributions.h"

namespace lyrefit {

double TailOf(double statistic, int degrees) {
  if (!(statistic > 0)) return 1;
  return std::max(FisherTail(statistic, 1, std::max(degrees, 1)), 1e-300);
}

namespace {
int At(std::uint64_t key) { return static_cast<int>(key & 0xffffffff); }
}  // namespace

NullDistribution::NullDistribution(const Eigen::Ref<const Eigen::VectorXf>& null_statistics,
                                   int degrees, Eigen::VectorXd* smallest)
    : degrees_(degrees) {
  const int count = static_cast<int>(null_statistics.size());
  // Sort in descending order, keeping positions. Statistics are never negative, so their inverted
  // bits, read as integers, ascend as the values descend. Integer keys with the position in the low
  // half are sorted.
  std::vector<std::uint64_t> order(count);
  for (int d = 0; d < count; ++d) {
    const float statistic = null_statistics[d];
    std::uint32_t bits;
    std::memcpy(&bits, &statistic, sizeof(bits));
    order[d] = static_cast<std::uint64_t>(~bits) << 32 | static_cast<std::uint32_t>(d);
  }
  std::sort(order.begin(), order.end());
  null_statistics_.resize(count);
  for (int rank = 0; rank < count; ++rank)
    null_statistics_[rank] = null_statistics[At(order[rank])];
  edge_ = static_cast<int>(kTail * count);
  edge_tail_ = TailOf(null_statistics_[edge_], degrees_);
  for (int rank = 0; rank < count && null_statistics_[rank] > 0; ++rank) {
    const double p = null_statistics_[rank] > null_statistics_[edge_]
                         ? Tail(null_statistics_[rank])
                         : std::max(kTail, static_cast<double>(rank + 1) / count);
    double& least = (*smallest)[At(order[rank])];
    least = std::min(least, p);
  }
}

double NullDistribution::Tail(double statistic) const {
  return kTail * TailOf(statistic, degrees_) / edge_tail_;
}

double NullDistribution::Of(double statistic) const {
  if (statistic > null_statistics_[edge_]) return Tail(statistic);
  const auto above = std::upper_bound(null_statistics_.begin(), null_statistics_.end(), statistic,
                                      std::greater<double>()) -
                     null_statistics_.begin();
  return std::max(kTail, static_cast<double>(above) / static_cast<double>(null_statistics_.size()));
}

double NullDistribution::Directions() const { return std::max(kTail / edge_tail_, 0.5); }

ListDistribution::ListDistribution(const Eigen::MatrixXf& null_statistics, int degrees)
    : smallest(Eigen::VectorXd::Ones(null_statistics.rows())),
      edge(static_cast<int>(kTail * static_cast<double>(null_statistics.rows()))) {
  for (int c = 0; c < null_statistics.cols(); ++c)
    laws.emplace_back(null_statistics.col(c), degrees, &smallest);
  std::sort(smallest.begin(), smallest.end());
}

double ListDistribution::Catalogue() const { return std::max(1.0, kTail / smallest[edge]); }

double ListDistribution::Corrected(double p) const {
  if (p < smallest[edge]) return std::max(p, kTail * p / smallest[edge]);
  const auto below = std::upper_bound(smallest.begin(), smallest.end(), p) - smallest.begin();
  return std::max(p, static_cast<double>(below) / static_cast<double>(smallest.size()));
}

}  // namespace lyrefit
