#include "lyrefit/estimate/refine/intervals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <mutex>
#include <set>

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Three parameters with standard errors of a hundredth of their values, and profiles that end at
// half and twice the value.
class FindIntervalsTest : public ::testing::Test {
 protected:
  FindIntervalsTest() {
    for (const char* symbol : {"a", "b", "c"}) {
      Estimate e;
      e.info.symbol = symbol;
      e.bounds = {0, 10};
      e.refined = 4;
      problem_.estimates.push_back(e);
    }
    problem_.active.assign(3, false);
    problem_.t.assign(3, 2);
    problem_.rules.undetermined = "undetermined";
    problem_.rules.no_shunt = "no shunt";
    problem_.spread.standard_error.assign(3, 0.04);
    problem_.spread.correlation = Eigen::MatrixXd::Identity(3, 3);
    problem_.spread.open.resize(3, 0);
    problem_.spread.condition = 7;
    problem_.threads = 1;
    problem_.profile = [this](const ProfileQuery& query) {
      const std::lock_guard<std::mutex> lock(mutex_);
      profiled_.insert(query.parameter);
      ProfileSide side;
      side.value = query.upper ? 8 : 2;
      return side;
    };
  }

  IntervalReport Find() { return FindIntervals(problem_, ProgressReporter()); }

  void Hold(int i, double value) {
    problem_.estimates[i].refined = value;
    problem_.active[i] = true;
    problem_.spread.standard_error[i] = kUnknown;
  }

  IntervalProblem problem_;
  std::set<int> profiled_;
  std::mutex mutex_;
};

TEST_F(FindIntervalsTest, AreSymmetricWhereTheModelIsNearlyLinear) {
  problem_.spread.correlation(0, 2) = problem_.spread.correlation(2, 0) = -0.95;
  problem_.spread.correlation(1, 2) = problem_.spread.correlation(2, 1) = 0.99;
  const IntervalReport found = Find();
  EXPECT_TRUE(profiled_.empty());
  EXPECT_EQ(found.condition, 7);
  for (const Estimate& e : found.estimates) {
    EXPECT_EQ(e.interval, IntervalMethod::kSymmetric);
    EXPECT_DOUBLE_EQ(e.low_95, 3.92);
    EXPECT_DOUBLE_EQ(e.high_95, 4.08);
    EXPECT_TRUE(e.identifiable);
  }
  ASSERT_EQ(found.correlations.size(), 2U);
  EXPECT_EQ(found.correlations[0].first + found.correlations[0].second, "bc");
  EXPECT_EQ(found.correlations[1].first + found.correlations[1].second, "ac");
}

TEST_F(FindIntervalsTest, AreProfiledWhereTheyReachABoundOrFar) {
  problem_.estimates[0].bounds.lower = 3.95;
  problem_.spread.standard_error[1] = 1;
  const IntervalReport found = Find();
  EXPECT_THAT(profiled_, ElementsAre(0, 1));
  EXPECT_EQ(found.estimates[0].low_95, 3.95);
  EXPECT_EQ(found.estimates[1].low_95, 2);
  EXPECT_EQ(found.estimates[1].high_95, 8);
  EXPECT_EQ(found.estimates[1].interval, IntervalMethod::kProfile);
}

TEST_F(FindIntervalsTest, AreAllProfiledBesideABoundOnlyIfRefitsAreCheap) {
  Hold(0, 10);
  EXPECT_EQ(Find().estimates[0].at_bound, BoundSide::kUpper);
  EXPECT_THAT(profiled_, ElementsAre(0, 1, 2));
  profiled_.clear();
  problem_.rules.thorough = false;
  EXPECT_EQ(Find().estimates[0].at_bound, BoundSide::kUpper);
  EXPECT_THAT(profiled_, ElementsAre(0));
}

TEST_F(FindIntervalsTest, WithoutAStandardErrorAreProfiledOrMarked) {
  problem_.spread.standard_error[1] = kUnknown;
  problem_.spread.open = Eigen::MatrixXd::Identity(3, 1);
  const IntervalReport all = Find();
  EXPECT_THAT(profiled_, ElementsAre(0, 1, 2));
  EXPECT_TRUE(all.estimates[1].identifiable);
  profiled_.clear();
  problem_.rules.thorough = false;
  const IntervalReport marked = Find();
  EXPECT_TRUE(profiled_.empty());
  EXPECT_FALSE(marked.estimates[1].identifiable);
  EXPECT_EQ(marked.estimates[1].reason, "undetermined");
  EXPECT_TRUE(marked.estimates[0].identifiable);
}

TEST_F(FindIntervalsTest, OfAnAbsentDiodeAreMarked) {
  problem_.estimates[0].info.kind = ParameterKind::kSaturation;
  problem_.estimates[0].info.with[0] = 1;
  problem_.estimates[1].info.kind = ParameterKind::kIdeality;
  Hold(0, 0);
  Hold(1, 4);
  const IntervalReport found = Find();
  EXPECT_THAT(profiled_, ElementsAre(0, 2)) << "the ideality of no diode may have any value";
  EXPECT_EQ(found.estimates[0].at_bound, BoundSide::kLower);
  EXPECT_THAT(found.estimates[0].reason, HasSubstr("no such diode"));
  EXPECT_EQ(found.estimates[1].at_bound, BoundSide::kNone);
  EXPECT_FALSE(found.estimates[1].identifiable);
  EXPECT_EQ(found.estimates[1].high_95, 10);
}

TEST_F(FindIntervalsTest, OfAShuntMayHaveNoUpperEnd) {
  Estimate& shunt = problem_.estimates[0];
  shunt.info.kind = ParameterKind::kShunt;
  shunt.bounds = {1, kInfinity};
  Hold(0, 1e30);
  problem_.profile = [](const ProfileQuery& query) {
    ProfileSide side;
    side.value = query.upper ? 1e30 : 2;
    side.at_bound = query.upper;
    return side;
  };
  const Estimate found = Find().estimates[0];
  EXPECT_EQ(found.at_bound, BoundSide::kUpper);
  EXPECT_EQ(found.low_95, 2);
  EXPECT_EQ(found.high_95, kInfinity);
  EXPECT_EQ(found.reason, "no shunt");
}

TEST_F(FindIntervalsTest, EndAfterTheLastStep) {
  problem_.spread.standard_error[0] = 1;
  problem_.last = IntervalStep::kSymmetric;
  EXPECT_EQ(Find().estimates[0].interval, IntervalMethod::kSymmetric);
  problem_.last = IntervalStep::kErrors;
  EXPECT_EQ(Find().estimates[0].interval, IntervalMethod::kNone);
  EXPECT_EQ(Find().estimates[0].standard_error, 1);
  problem_.last = IntervalStep::kBounds;
  EXPECT_TRUE(std::isnan(Find().estimates[0].standard_error));
  EXPECT_TRUE(profiled_.empty());
}

TEST_F(FindIntervalsTest, CollectLowerOptima) {
  problem_.spread.standard_error.assign(3, 1);
  problem_.profile = [](const ProfileQuery& query) {
    ProfileSide side;
    if (query.upper) side.better = {1.0 * query.parameter};
    side.settled = query.parameter != 1;
    return side;
  };
  const IntervalReport found = Find();
  EXPECT_THAT(found.better, ElementsAre(ElementsAre(0), ElementsAre(1), ElementsAre(2)));
  EXPECT_EQ(found.estimates[1].interval, IntervalMethod::kUnsettled);
}

}  // namespace
}  // namespace lyrefit
