#include "lyrefit/certify/beyond.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace lyrefit {

double BoundBeyond(const MixtureData& data, double rs) {
  const Eigen::VectorXd vd = data.voltage_V + rs * data.current_A;
  std::vector<int> falling(static_cast<std::size_t>(vd.size()));
  std::iota(falling.begin(), falling.end(), 0);
  std::sort(falling.begin(), falling.end(), [&](int a, int b) { return vd[a] > vd[b]; });
  // The best the model can do for two points is to give both their mean.
  double largest = data.current_A[falling.front()];
  double drop = 0;
  for (const int k : falling) {
    largest = std::max(largest, data.current_A[k]);
    drop = std::max(drop, largest - data.current_A[k]);
  }
  return 0.25 * drop * drop;
}

}  // namespace lyrefit
