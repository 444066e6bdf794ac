#include "lyrefit/diagnose/null_law.h"

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

NullLaw::NullLaw(const Eigen::Ref<const Eigen::VectorXf>& nulls, int degrees,
                 Eigen::VectorXd* smallest)
    : degrees_(degrees) {
  const int count = static_cast<int>(nulls.size());
  // Falling statistics, which are not negative, are falling bits: sorted as numbers with the
  // position behind them.
  std::vector<std::uint64_t> order(count);
  for (int d = 0; d < count; ++d) {
    const float statistic = nulls[d];
    std::uint32_t bits;
    std::memcpy(&bits, &statistic, sizeof(bits));
    order[d] = static_cast<std::uint64_t>(~bits) << 32 | static_cast<std::uint32_t>(d);
  }
  std::sort(order.begin(), order.end());
  nulls_.resize(count);
  for (int rank = 0; rank < count; ++rank) nulls_[rank] = nulls[At(order[rank])];
  edge_ = static_cast<int>(kTail * count);
  edge_tail_ = TailOf(nulls_[edge_], degrees_);
  for (int rank = 0; rank < count && nulls_[rank] > 0; ++rank) {
    const double p = nulls_[rank] > nulls_[edge_]
                         ? Tail(nulls_[rank])
                         : std::max(kTail, static_cast<double>(rank + 1) / count);
    double& least = (*smallest)[At(order[rank])];
    least = std::min(least, p);
  }
}

double NullLaw::Tail(double statistic) const {
  return kTail * TailOf(statistic, degrees_) / edge_tail_;
}

double NullLaw::Of(double statistic) const {
  if (statistic > nulls_[edge_]) return Tail(statistic);
  const auto above =
      std::upper_bound(nulls_.begin(), nulls_.end(), statistic, std::greater<double>()) -
      nulls_.begin();
  return std::max(kTail, static_cast<double>(above) / static_cast<double>(nulls_.size()));
}

double NullLaw::Directions() const { return std::max(kTail / edge_tail_, 0.5); }

ListLaw::ListLaw(const Eigen::MatrixXf& nulls, int degrees)
    : smallest(Eigen::VectorXd::Ones(nulls.rows())),
      edge(static_cast<int>(kTail * static_cast<double>(nulls.rows()))) {
  for (int c = 0; c < nulls.cols(); ++c) laws.emplace_back(nulls.col(c), degrees, &smallest);
  std::sort(smallest.begin(), smallest.end());
}

double ListLaw::Catalogue() const { return std::max(1.0, kTail / smallest[edge]); }

double ListLaw::Corrected(double p) const {
  if (p < smallest[edge]) return std::max(p, kTail * p / smallest[edge]);
  const auto below = std::upper_bound(smallest.begin(), smallest.end(), p) - smallest.begin();
  return std::max(p, static_cast<double>(below) / static_cast<double>(smallest.size()));
}

}  // namespace lyrefit
