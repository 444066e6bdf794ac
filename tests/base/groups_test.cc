#include "lyrefit/base/groups.h"

#include <gtest/gtest.h>

namespace lyrefit {
namespace {

TEST(GroupByRule, EndsGroupsWhereTheRuleSays) {
  EXPECT_EQ(GroupByRule(5, {}), (Grouping{0, 5}));
  EXPECT_EQ(GroupByRule(5, {2}), (Grouping{0, 2, 4, 5}));
  GroupRule rule;
  rule.place = {0, 0.5, 1, 1.5, 9};
  rule.widest = 1;
  EXPECT_EQ(GroupByRule(5, rule), (Grouping{0, 3, 4, 5}));
  rule.place = {7, 7, 2, 2, 2};
  rule.widest = 0;
  EXPECT_EQ(GroupByRule(5, rule), (Grouping{0, 2, 5}));
  rule.place.clear();
  rule.alone = {0, 0, 1, 0, 0};
  EXPECT_EQ(GroupByRule(5, rule), (Grouping{0, 2, 3, 5}));
  EXPECT_EQ(GroupByRule(0, {}), Grouping{0});
}

TEST(EqualGroups, HaveEquallyManyPointsToOne) {
  EXPECT_EQ(EqualGroups(7, 3), (Grouping{0, 2, 4, 7}));
  EXPECT_EQ(EachAlone(3), (Grouping{0, 1, 2, 3}));
  EXPECT_EQ(EachAlone(0), Grouping{0});
}

TEST(Grouping, LeadsFromPointsToGroupsAndBack) {
  const Grouping first = {0, 2, 3, 6};
  EXPECT_EQ(GroupsWith(first, {1, 2, 5}), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(PointsIn(first, {2, 0}), (std::vector<int>{3, 4, 5, 0, 1}));
}

TEST(Means, OfGroupsAndTheirErrors) {
  const Grouping first = {0, 1, 5};
  EXPECT_EQ(Means(first, {4, 1, 2, 3, 6}), (std::vector<double>{4, 3}));
  EXPECT_EQ(MeanErrors(first, {0.5, 2, 2, 2, 2}), (std::vector<double>{0.5, 1}));
  EXPECT_TRUE(Means(first, {}).empty());
}

TEST(RisingOrder, KeepsTheOrderOfEqualValues) {
  EXPECT_EQ(RisingOrder({3, 1, 3, 1}), (std::vector<int>{1, 3, 0, 2}));
  EXPECT_EQ(RisingOrder({1, 1, 2}), (std::vector<int>{0, 1, 2}));
}

}  // namespace
}  // namespace lyrefit
