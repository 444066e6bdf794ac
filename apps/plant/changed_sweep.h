#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

#include "plant/campaign_shape.h"

namespace lyrefit {

// A falling curve of points, in parts of Isc and Voc.
struct SweepPoints {
  std::vector<double> v, i;

  // The current at a voltage, the voltage at a current; beyond the ends, the end.
  double CurrentAt(double at) const {
    const auto above = std::lower_bound(v.begin(), v.end(), at);
    if (above == v.begin()) return i.front();
    if (above == v.end()) return i.back();
    const auto k = static_cast<std::size_t>(above - v.begin());
    return i[k - 1] + (i[k] - i[k - 1]) * (at - v[k - 1]) / (v[k] - v[k - 1]);
  }
  double VoltageAt(double at) const {
    const auto below = std::lower_bound(i.begin(), i.end(), at, std::greater<>());
    if (below == i.begin()) return v.front();
    if (below == i.end()) return v.back();
    const auto k = static_cast<std::size_t>(below - i.begin());
    return v[k - 1] + (v[k] - v[k - 1]) * (at - i[k - 1]) / (i[k] - i[k - 1]);
  }
  std::size_t AtMaximumPower() const {
    std::size_t best = 0;
    for (std::size_t k = 1; k < v.size(); ++k) {
      if (v[k] * i[k] > v[best] * i[best]) best = k;
    }
    return best;
  }
  double Power() const { return v[AtMaximumPower()] * i[AtMaximumPower()]; }
  // Strictly falling, with rising voltages.
  void Order() {
    constexpr double kLeast = 1e-7;
    for (std::size_t k = 1; k < v.size(); ++k) {
      v[k] = std::max(v[k], v[k - 1] + kLeast);
      i[k] = std::min(i[k], i[k - 1] - kLeast);
    }
  }
};

// The sweep as a dense curve through its currents and its maximum power. Of a sweep whose currents
// are not known, that of a usual module with the same maximum power.
SweepPoints PointsOf(const SweepFigures& sweep);

// What a mechanism of this size makes of a sweep; see MechanismFit.
SweepPoints Changed(const SweepPoints& sound, Mechanism mechanism, double size, double part,
                    bool spread, const StringFacts& facts);

}  // namespace lyrefit
