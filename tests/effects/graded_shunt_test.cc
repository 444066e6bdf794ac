#include <gtest/gtest.h>

#include <cmath>

#include "effects/brute_module.h"

namespace lyrefit {
namespace {

// The few groups of the effect stand for all cells, each with the leak of its place.
TEST(GradedShuntTest, IsTheSumOfAllCells) {
  for (const double steep : {1.0, 4.0, 6.0}) {
    constexpr double kMean = 0.2;
    std::vector<BruteCells> cells;
    for (int k = 0; k < 60; ++k) {
      const double place = (k + 0.5) / 60;
      const double grown = std::expm1(steep * place) / (std::expm1(steep) - steep);
      cells.push_back({1, 1, kMean * steep * grown});
    }
    ExpectBruteCurrents("graded_shunt", {kMean, steep}, 60, {{{cells}, false}}, nullptr, 3, 3e-3);
  }
}

TEST(GradedShuntTest, HasTheMeanLeak) {
  CellGroup<Pack> groups[kMostGroups];
  Cell<Pack> cell;
  cell.group = groups;
  const Pack p[] = {0.4, 5.0};
  FindEffect("graded_shunt")->cell.For<Pack>()(p, &cell);
  double mean = 0, share = 0;
  for (int g = 0; g < cell.groups; ++g) {
    mean += groups[g].share[0] * groups[g].leak[0];
    share += groups[g].share[0];
  }
  EXPECT_NEAR(share, 1, 1e-14);
  EXPECT_NEAR(mean, 0.4, 1e-9);
}

// Two or five cells are no string along which leaks grow, nor a distribution.
TEST(GradedShuntTest, NeedsManyCells) {
  DataTraits traits = SyntheticReadings(DataKind::kForward, 60).traits;
  for (const char* id : {"graded_shunt", "scatter", "weak_cell", "covered_edge"}) {
    traits.cells = 60;
    EXPECT_FALSE(FindEffect(id)->WhyNot(traits)) << id;
    traits.cells = 2;
    EXPECT_TRUE(FindEffect(id)->WhyNot(traits)) << id;
  }
}

}  // namespace
}  // namespace lyrefit
