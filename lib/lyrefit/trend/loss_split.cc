#include "lyrefit/trend/loss_split.h"

namespace lyrefit {

double PowerOf(const TrendDevice& device, const TrendState& state, double temperature_C) {
  return MaximumPower(device, state[kTrendLight], state[kTrendSeries], state[kTrendRecombination],
                      state[kTrendShunt], temperature_C);
}

std::array<double, kTrendParameters> SplitLoss(const TrendDevice& device, const TrendState& before,
                                               const TrendState& after, double temperature_C) {
  constexpr int kSets = 1 << kTrendParameters;
  // Weights of a set of this size in the mean over all orders: s! (3 - s)! / 4!.
  constexpr std::array<double, kTrendParameters> kWeight = {1.0 / 4, 1.0 / 12, 1.0 / 12, 1.0 / 4};
  std::array<double, kSets> power{};
  for (int set = 0; set < kSets; ++set) {
    TrendState state = before;
    for (int i = 0; i < kTrendParameters; ++i) {
      if ((set >> i & 1) != 0) state[i] = after[i];
    }
    power[set] = PowerOf(device, state, temperature_C);
  }
  std::array<double, kTrendParameters> shares{};
  for (int i = 0; i < kTrendParameters; ++i) {
    for (int set = 0; set < kSets; ++set) {
      if ((set >> i & 1) != 0) continue;
      int size = 0;
      for (int k = 0; k < kTrendParameters; ++k) size += set >> k & 1;
      shares[i] += kWeight[size] * (power[set] - power[set | 1 << i]);
    }
  }
  return shares;
}

}  // namespace lyrefit
