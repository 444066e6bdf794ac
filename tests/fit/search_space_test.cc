#include "lyrefit/fit/search_space.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lyrefit {
namespace {

TEST(SearchSpace, IsLinearLogarithmicOrFixedAsTheBoundsSay) {
  std::vector<ParameterBounds> bounds(3);
  bounds[0] = {0, 4, 1, 3, SearchScale::kLinear};
  bounds[1] = {0, 1, 1e-10, 1e-4, SearchScale::kLog};
  bounds[2] = {0, 9, 0, 9, SearchScale::kLinear};
  const SearchSpace space(bounds, {std::nan(""), std::nan(""), 5});
  ASSERT_EQ(space.dimensions(), 2);
  EXPECT_EQ(space.box().lower, (std::vector<double>{1, 0}));
  EXPECT_NEAR(space.box().upper[1], std::log(1e6), 1e-12);
  double p[3];
  const double x[] = {2.5, 0.5 * space.box().upper[1]};
  space.ToParameters(x, p);
  EXPECT_EQ(p[0], 2.5);
  EXPECT_NEAR(p[1], 1e-7, 1e-19);
  EXPECT_EQ(p[2], 5);
}

}  // namespace
}  // namespace lyrefit
