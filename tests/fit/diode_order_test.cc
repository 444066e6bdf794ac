#include "lyrefit/fit/diode_order.h"

#include <gtest/gtest.h>

namespace lyrefit {
namespace {

const ParameterBounds kAny = {0, 1, 0, 1, SearchScale::kLinear};

TEST(OrderDiodes, SortsByIdealityAndPutsVanishedOnesLast) {
  //                       Iph Is1 n1   Rs Rsh Is2 n2   Is3 n3
  std::vector<double> p = {1, 0, 1.1, 2, 3, 7, 1.9, 8, 1.5};
  std::vector<bool> held = {false, true, true, false, false, false, false, false, false};
  OrderDiodes(std::vector<ParameterBounds>(9, kAny), &p, &held);
  EXPECT_EQ(p, (std::vector<double>{1, 8, 1.5, 2, 3, 7, 1.9, 0, 1.1}));
  EXPECT_EQ(held, (std::vector<bool>{false, false, false, false, false, false, false, true, true}));
}

TEST(OrderDiodes, LeavesDiodesWithBoundsOfTheirOwnAlone) {
  std::vector<ParameterBounds> bounds(7, kAny);
  bounds[6].lower = 0.5;
  std::vector<double> p = {1, 2, 1.9, 3, 4, 5, 1.1};
  const std::vector<double> before = p;
  OrderDiodes(bounds, &p, nullptr);
  EXPECT_EQ(p, before);
}

}  // namespace
}  // namespace lyrefit
