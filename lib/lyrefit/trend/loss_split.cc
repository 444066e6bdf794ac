#include "lyrefit/trend/loss_split.h"

namespace lyrefit {
namespace {

constexpr int kExchanged = kPartMismatch;  // parts before it

// `before` with the parts of the set taken from `after`.
DeviceState Mixed(const DeviceState& before, const DeviceState& after, int set) {
  const auto has = [set](int part) { return (set >> part & 1) != 0; };
  DeviceState state = before;
  if (has(kPartLight)) state.photocurrent_A = after.photocurrent_A;
  if (has(kPartSeries)) state.resistance_series_ohm = after.resistance_series_ohm;
  if (has(kPartRecombination)) {
    state.saturation_current_A = after.saturation_current_A;
    state.saturation_current_2_A = after.saturation_current_2_A;
  }
  if (has(kPartShunt)) state.shunt_conductance_S = after.shunt_conductance_S;
  return state;
}

}  // namespace

std::array<double, kTrendParts> SplitLoss(const TrendDevice& device, const DeviceState& before,
                                          const DeviceState& after, double temperature_C) {
  constexpr int kSets = 1 << kExchanged;
  // Weight of a set of this size in the mean over all orders of four: s! (3 - s)! / 4!.
  constexpr std::array<double, kExchanged> kWeight = {1.0 / 4, 1.0 / 12, 1.0 / 12, 1.0 / 4};
  std::array<double, kSets> power{};
  for (int set = 0; set < kSets; ++set) {
    power[set] = MaximumPowerPoint(device, Mixed(before, after, set), temperature_C).power_W();
  }
  std::array<double, kTrendParts> shares{};
  for (int part = 0; part < kExchanged; ++part) {
    for (int set = 0; set < kSets; ++set) {
      if ((set >> part & 1) != 0) continue;
      int size = 0;
      for (int k = 0; k < kExchanged; ++k) size += set >> k & 1;
      shares[part] += kWeight[size] * (power[set] - power[set | 1 << part]);
    }
  }
  return shares;
}

}  // namespace lyrefit
