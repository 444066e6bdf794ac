#include "plant/neighbours.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lyrefit/base/random.h"

namespace lyrefit {
namespace {

using Groups = std::vector<std::vector<Neighbour>>;

// Strings with the relative scatter stated below. Every combiner has its own irradiance.
Groups MakePlant(int groups, int strings, std::uint64_t seed) {
  RandomStream random(seed);
  Groups plant(groups);
  for (auto& group : plant) {
    const double light = 600 + 400 * random.Uniform();
    for (int i = 0; i < strings; ++i) {
      group.push_back(
          {light * (1 + 0.01 * random.Uniform()),
           {0.009 * (1 + 0.01 * random.Normal()), 800 * (1 + 0.003 * random.Normal()),
            0.75 * (1 + 0.005 * random.Normal()), 5.4 * (1 + 0.012 * random.Normal())}});
    }
  }
  return plant;
}

struct Alarms {
  int strings = 0;
  int flagged = 0;
};

bool IsFlagged(const NeighbourDeviation& one,
               const std::array<double, kNeighbourQuantities>& limits) {
  return std::get<bool>(NeighbourCells(one, limits)[5]);
}

Alarms CountAlarms(const Groups& plant, double level) {
  NeighbourScatter scatter;
  for (const auto& group : plant) scatter.Add(DeviationsAmong(group, 0.05));
  Alarms alarms;
  for (const auto& group : plant) {
    const auto deviations = DeviationsAmong(group, 0.05);
    const auto limits = scatter.Limits(deviations, level);
    for (const NeighbourDeviation& one : deviations) {
      ++alarms.strings;
      alarms.flagged += IsFlagged(one, limits) ? 1 : 0;
    }
  }
  return alarms;
}

TEST(Neighbours, KeepTheRateOfFalseAlarms) {
  // Many plants of each size. At a level of 2 % the number of alarms is large enough for the rate.
  const struct {
    int plants, groups, strings;
  } cases[] = {{400, 1, 10}, {200, 3, 8}, {60, 10, 12}, {4, 200, 12}};
  for (const auto& one : cases) {
    Alarms sum;
    for (int plant = 0; plant < one.plants; ++plant) {
      const Alarms alarms = CountAlarms(MakePlant(one.groups, one.strings, plant), 0.02);
      sum.strings += alarms.strings;
      sum.flagged += alarms.flagged;
    }
    const double rate = static_cast<double>(sum.flagged) / sum.strings;
    RecordProperty(std::to_string(one.groups), std::to_string(rate));
    EXPECT_LE(rate, 0.02 * 1.15) << one.groups << " groups of " << one.strings;
    EXPECT_GT(rate, 0.001) << "not by never flagging";
  }
}

TEST(Neighbours, FlagAStringWithABypassedSubstring) {
  Groups plant = MakePlant(20, 12, 1);
  plant[7][3].values[kVoc] *= 1 - 1.0 / 60;  // one of 60 substrings is lost
  plant[7][3].values[kPmaxPerLight] *= 1 - 1.0 / 60;
  NeighbourScatter scatter;
  for (const auto& group : plant) scatter.Add(DeviationsAmong(group, 0.05));
  const auto deviations = DeviationsAmong(plant[7], 0.05);
  const auto limits = scatter.Limits(deviations, 0.001);
  for (std::size_t i = 0; i < deviations.size(); ++i) {
    EXPECT_EQ(IsFlagged(deviations[i], limits), i == 3) << i;
  }
  EXPECT_THAT(std::get<std::string>(NeighbourCells(deviations[3], limits)[6]),
              ::testing::StartsWith("Voc -1."));
  EXPECT_EQ(deviations[3].peers, 11);
}

TEST(Neighbours, AreComparedUnderLikeLightOnly) {
  std::vector<Neighbour> group = MakePlant(1, 6, 1).front();
  group[0].irradiance_W_m2 *= 1.2;
  group[1].irradiance_W_m2 = kUnknown;
  const auto deviations = DeviationsAmong(group, 0.05);
  // Each string has at most three peers in similar light, too few for a comparison.
  for (const NeighbourDeviation& one : deviations) EXPECT_EQ(one.peers, 0);
  const auto cells = NeighbourCells(deviations[0], {});
  EXPECT_EQ(cells.size(), NeighbourColumns().size());
  EXPECT_TRUE(std::holds_alternative<std::monostate>(cells[5]));
}

}  // namespace
}  // namespace lyrefit
