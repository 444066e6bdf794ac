#include <gtest/gtest.h>

#include <algorithm>

#include "effects/brute_module.h"
#include "lyrefit/effects/odd_cells.h"

namespace lyrefit {
namespace {

TEST(DimCellsTest, AreTheSumOfAllCells) {
  ExpectBruteCurrents("dim_cells", {0.7, 0.2, 0.4, 0.55, 0, 2, 1, 4, 3, 0.5, 1}, 60,
                      {{{{{18, 1, 0}, {1, 0.3, 0}, {1, 0.8, 0}}}, true},
                       {{{{19, 1, 0}, {1, 0.6, 0}}}, true},
                       {{{{19, 1, 0}, {1, 0.45, 0}}}, true}},
                      [](BruteModule* module) {
                        module->soft_voltage = 4;
                        module->soft_exponent = 3;
                      });
}

// Each of two substrings is two chains in parallel, of which one has dim cells.
TEST(DimCellsTest, LieInOneOfTwoChains) {
  ExpectBruteCurrents("dim_cells", {0.35, 0.1, 0.25, 0, 0, 2, 1, 4, 3, 0.5, 2}, 60,
                      {{{{{18, 1, 0}, {1, 0.3, 0}, {1, 0.8, 0}}, {{20, 1, 0}}}, true},
                       {{{{19, 1, 0}, {1, 0.5, 0}}, {{20, 1, 0}}}, true},
                       {{{{20, 1, 0}}}, false}},
                      [](BruteModule* module) {
                        module->soft_voltage = 4;
                        module->soft_exponent = 3;
                      });
}

// The lights of three cells in two substrings are plateaus of the curve, and an early guess has
// them in the right ones.
TEST(DimCellsTest, AreGuessedFromTheStaircase) {
  Readings readings = SyntheticReadings(DataKind::kForward, 60);
  std::vector<Reading> fine;
  for (int k = 0; k <= 120; ++k) {
    fine.push_back(readings.points.front());
    fine.back().voltage = 0.62 * k / 120;
  }
  readings.points = fine;
  const Settled at = WithEffect(*FindEffect("dim_cells"),
                                {0.75, 0.3, 0.55, 0, 0, 2, 1, 3.5, 3.4, 0.5, 1}, readings);
  const std::vector<double> current = Currents(at.law, readings, at.p);
  for (std::size_t k = 0; k < fine.size(); ++k) readings.points[k].current = current[k];
  readings.pivot_voltage = 0.61;  // beyond the last knee
  const CurveShape shape = ShapeOf(readings);
  const std::vector<double> deficits = PlateauDeficits(shape, 5);
  ASSERT_EQ(deficits.size(), 3U);
  const double expected[] = {0.75, 0.55, 0.3};
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(deficits[k], expected[k], 0.04) << k;
  const auto guesses = GuessDimPlaces(shape, readings.traits, deficits, 3, 10);
  ASSERT_GE(guesses.size(), 5U);
  const auto right = std::find_if(guesses.begin(), guesses.end(), [](const DimPlaces& guess) {
    return guess.places == std::vector<int>{0, 1, 0} && guess.chains == 1;
  });
  ASSERT_NE(right, guesses.end());
  EXPECT_LT(right - guesses.begin(), 5);
  EXPECT_NEAR(right->soft_voltage, 3.5, 2.6);
}

}  // namespace
}  // namespace lyrefit
