#include "lyrefit/certify/tail_bound.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <vector>

#include "lyrefit/certify/real_data.h"

namespace lyrefit {
namespace {

// Points of rising current whose junction voltage does not fall. A model's current does not rise
// along them, so it fits them no better than their mean does.
struct Chain {
  std::vector<Eigen::Index> points;
};

// Half the sum of squares about the mean.
template <class Real>
Real HalfSpread(const Eigen::VectorXd& current, const Chain& chain) {
  Real sum(0), squares(0);
  for (const Eigen::Index k : chain.points) sum += Real(current[k]);
  const Real mean = sum / Real(static_cast<double>(chain.points.size()));
  for (const Eigen::Index k : chain.points) {
    const Real off = Real(current[k]) - mean;
    squares += off * off;
  }
  return Real(0.5) * squares;
}

}  // namespace

template <class Real>
double BoundTail(const MixtureData& data, double rs) {
  const ArrayOf<Real> vd = JunctionVoltage<Real>(data, rs);
  std::vector<Eigen::Index> rising(static_cast<std::size_t>(vd.size()));
  std::iota(rising.begin(), rising.end(), 0);
  const Eigen::VectorXd& current = data.current_A;
  std::sort(rising.begin(), rising.end(), [&](Eigen::Index a, Eigen::Index b) {
    return current[a] < current[b] ||
           (current[a] == current[b] && data.voltage_V[a] < data.voltage_V[b]);
  });
  // Appends every point to the chain whose last junction voltage is the closest below.
  std::vector<Chain> chains;
  std::multimap<double, std::size_t> ends;
  for (const Eigen::Index k : rising) {
    auto next = ends.upper_bound(Lower(vd[k]));
    std::size_t chain = chains.size();
    if (next == ends.begin()) {
      chains.emplace_back();
    } else {
      chain = std::prev(next)->second;
      ends.erase(std::prev(next));
    }
    chains[chain].points.push_back(k);
    ends.emplace(Upper(vd[k]), chain);
  }
  Real sum(0);
  for (const Chain& chain : chains) sum += HalfSpread<Real>(current, chain);
  return std::max(0.0, Lower(sum));
}

template double BoundTail<double>(const MixtureData&, double);
template double BoundTail<Interval>(const MixtureData&, double);

double BoundTailSolved(const MixtureData& data, double rs) {
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
