#include "lyrefit/certify/beyond.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "lyrefit/certify/real_data.h"

namespace lyrefit {
namespace {

std::vector<int> ByFalling(const Eigen::ArrayXd& values) {
  std::vector<int> falling(static_cast<std::size_t>(values.size()));
  std::iota(falling.begin(), falling.end(), 0);
  std::sort(falling.begin(), falling.end(), [&](int a, int b) { return values[a] > values[b]; });
  return falling;
}

}  // namespace

template <class Real>
double BoundBeyond(const MixtureData& data, double rs) {
  const ArrayOf<Real> vd = JunctionVoltage<Real>(data, rs);
  Eigen::ArrayXd least(vd.size()), most(vd.size());
  for (Eigen::Index k = 0; k < vd.size(); ++k) {
    least[k] = Lower(vd[k]);
    most[k] = Upper(vd[k]);
  }
  const std::vector<int> above = ByFalling(least);
  auto next = above.begin();
  // The best the model can do for two points is to give both their mean.
  double largest = -kInfinity;  // current of those whose voltage is no lower for certain
  double drop = 0;
  for (const int k : ByFalling(most)) {
    for (; next != above.end() && least[*next] >= most[k]; ++next) {
      largest = std::max(largest, data.current_A[*next]);
    }
    drop = std::max(drop, Lower(Real(largest) - Real(data.current_A[k])));
  }
  return std::max(0.0, Lower(Real(0.25) * Real(drop) * Real(drop)));
}

template double BoundBeyond<double>(const MixtureData&, double);
template double BoundBeyond<Interval>(const MixtureData&, double);

double BoundBeyondSolved(const MixtureData& data, double rs) {
  const Eigen::Index points = data.target_A.size();
  const Eigen::ArrayXd square = data.weight.array().square().inverse();
  double largest = 0;
  for (Eigen::Index low = 0; low < points; ++low) {
    for (Eigen::Index high = 0; high < points; ++high) {
      const double width = data.voltage_V[high] - data.voltage_V[low];
      if (width < 0) continue;
      const double fall = data.target_A[low] - data.target_A[high];
      const double miss = std::max(fall - width / rs, -fall);
      if (miss > 0) largest = std::max(largest, 0.5 * miss * miss / (square[low] + square[high]));
    }
  }
  return largest;
}

}  // namespace lyrefit
