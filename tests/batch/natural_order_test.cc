#include "lyrefit/stream/natural_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace lyrefit {
namespace {

TEST(NaturalLess, CountsNumbersAndIsAnOrder) {
  const std::vector<std::string> sorted = {"",
                                           "Z",
                                           "a",
                                           "a1",
                                           "a01",
                                           "a2",
                                           "a2b",
                                           "a10",
                                           "a10b1",
                                           "a10b20",
                                           "b",
                                           "b\xc3\xa4",
                                           "b\xff",
                                           "str99999999999999999999",
                                           "str100000000000000000000"};
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    for (std::size_t j = 0; j < sorted.size(); ++j) {
      EXPECT_EQ(NaturalLess(sorted[i], sorted[j]), i < j) << sorted[i] << " " << sorted[j];
    }
  }
}

}  // namespace
}  // namespace lyrefit
