#include "lyrefit/trend/loss_split.h"

#include <gtest/gtest.h>

#include <cmath>

#include "synthetic/draw.h"
#include "trend/made_sweeps.h"

namespace lyrefit {
namespace {

constexpr double kSplit_C = 45;

double PowerOf(const DeviceState& state) {
  return MaximumPowerPoint(MadeDevice(), state, kSplit_C).power_W();
}

DeviceState DrawDamage(const DeviceState& whole, RandomStream* random) {
  DeviceState state = whole;
  state.photocurrent_A *= Between(random, 0.5, 1.1);
  state.resistance_series_ohm *= Between(random, 0.8, 3);
  state.saturation_current_A *= LogUniform(random, 0.5, 20);
  state.saturation_current_2_A *= LogUniform(random, 0.5, 20);
  state.shunt_conductance_S *= LogUniform(random, 0.5, 20);
  return state;
}

TEST(SplitLoss, SharesAddUpToTheLoss) {
  const DeviceState whole = MadeState(MadeDevice(), 800, kSplit_C);
  RandomStream random(36);
  for (int draw = 0; draw < 200; ++draw) {
    const DeviceState damaged = DrawDamage(whole, &random);
    const auto shares = SplitLoss(MadeDevice(), whole, damaged, kSplit_C);
    double sum = 0;
    for (const double share : shares) sum += share;
    EXPECT_NEAR(sum, PowerOf(whole) - PowerOf(damaged), 1e-11 * PowerOf(whole));
    EXPECT_EQ(shares[kPartMismatch], 0);
  }
}

TEST(SplitLoss, AParameterAloneIsItsOwnShare) {
  const DeviceState whole = MadeState(MadeDevice(), 800, kSplit_C);
  std::array<DeviceState, kPartMismatch> damaged;
  damaged.fill(whole);
  damaged[kPartLight].photocurrent_A *= 0.9;
  damaged[kPartSeries].resistance_series_ohm *= 2;
  damaged[kPartRecombination].saturation_current_A *= 3;
  damaged[kPartRecombination].saturation_current_2_A *= 3;
  damaged[kPartShunt].shunt_conductance_S *= 5;
  for (int part = 0; part < kPartMismatch; ++part) {
    const auto shares = SplitLoss(MadeDevice(), whole, damaged[part], kSplit_C);
    for (int other = 0; other < kTrendParts; ++other) {
      if (other == part) continue;
      EXPECT_EQ(shares[other], 0) << part << ' ' << other;
    }
    EXPECT_GT(shares[part], 0.1) << part;
    EXPECT_NEAR(shares[part], PowerOf(whole) - PowerOf(damaged[part]), 1e-11 * PowerOf(whole));
  }
}

TEST(SplitLoss, WayBackHasTheOppositeShares) {
  const DeviceState whole = MadeState(MadeDevice(), 600, kSplit_C);
  RandomStream random(37);
  for (int draw = 0; draw < 50; ++draw) {
    const DeviceState damaged = DrawDamage(whole, &random);
    const auto there = SplitLoss(MadeDevice(), whole, damaged, kSplit_C);
    const auto back = SplitLoss(MadeDevice(), damaged, whole, kSplit_C);
    for (int part = 0; part < kTrendParts; ++part) {
      EXPECT_NEAR(there[part], -back[part], 1e-11 * PowerOf(whole));
    }
  }
}

TEST(SplitLoss, WithoutAChangeIsZero) {
  const DeviceState whole = MadeState(MadeDevice(), 600, kSplit_C);
  for (const double share : SplitLoss(MadeDevice(), whole, whole, kSplit_C)) EXPECT_EQ(share, 0);
}

}  // namespace
}  // namespace lyrefit
