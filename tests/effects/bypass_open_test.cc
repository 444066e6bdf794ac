#include <gtest/gtest.h>

#include "effects/brute_module.h"

namespace lyrefit {
namespace {

void ConductSoftly(BruteModule* module) {
  module->soft_voltage = 12;
  module->soft_exponent = 5;
}

TEST(BypassOpenTest, LeavesADimCellToTheWholeString) {
  ExpectBruteCurrents("bypass_open", {0.6, 1.0 / 3, 12, 5, 1, 1}, 60,
                      {{{{{19, 1, 0}, {1, 0.4, 0}}}, false}, {{{{40, 1, 0}}}, false}},
                      ConductSoftly);
}

// In a half-cut module one of two parallel chains has the dim cells.
TEST(BypassOpenTest, LeavesDimCellsOfOneChain) {
  ExpectBruteCurrents("bypass_open", {0.3, 1.0 / 3, 12, 5, 2, 2}, 60,
                      {{{{{18, 1, 0}, {2, 0.4, 0}}, {{20, 1, 0}}}, false}, {{{{40, 1, 0}}}, false}},
                      ConductSoftly, 9);
}

TEST(BypassOpenTest, LeavesADimSubstring) {
  ExpectBruteCurrents("bypass_open", {0.6, 1.0 / 3, 12, 5, 0, 1}, 60,
                      {{{{{20, 0.4, 0}, {40, 1, 0}}}, false}}, ConductSoftly);
}

}  // namespace
}  // namespace lyrefit
