#include "lyrefit/stream/seen_ids.h"

#include <gtest/gtest.h>

#include <string>

namespace lyrefit {
namespace {

TEST(SeenIds, FindsEveryRepetitionAlsoWhenTheTableHasGrown) {
  SeenIds ids;
  constexpr int kMany = 2100000;  // the table grows at 1.9 million
  for (int i = 0; i < kMany; ++i) {
    ASSERT_FALSE(ids.Insert("site/inv/" + std::to_string(i), {i % 7, i + 1}));
  }
  for (int i = 0; i < kMany; i += 1000) {
    const auto place = ids.Insert("site/inv/" + std::to_string(i), {0, 0});
    ASSERT_TRUE(place);
    EXPECT_EQ(place->input, i % 7);
    EXPECT_EQ(place->line, i + 1);
  }
}

TEST(SeenIds, TellsShortIdsApart) {
  SeenIds ids;
  const std::string zero(1, '\0');
  EXPECT_FALSE(ids.Insert("", {}));
  EXPECT_FALSE(ids.Insert(zero, {}));
  EXPECT_FALSE(ids.Insert(zero + zero, {}));
  EXPECT_TRUE(ids.Insert(zero, {}));
}

}  // namespace
}  // namespace lyrefit
