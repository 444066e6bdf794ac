#include "lyrefit/estimate/refine/multistart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lyrefit/base/random.h"

namespace lyrefit {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

// A point on a line with an optimum at every integer. The value of an optimum is 1 plus its
// distance from 0. A step halves the distance from the nearest optimum.
struct Point : MultistartEnd {
  double x = 0;
  int calls = 0;
};

void Refine(const MultistartStage& stage, Point* at) {
  const double optimum = std::round(at->x);
  const double off = (at->x - optimum) * std::pow(0.5, stage.steps);
  at->x = optimum + off;
  at->value = 1 + std::fabs(optimum) + std::fabs(off) + 100 * stage.problem;
  if (optimum > 1000) at->value = HUGE_VAL;
  ++at->calls;
}

bool Same(const Point& a, const Point& b) { return std::fabs(a.x - b.x) < 1e-6; }

MultistartRules Rules(std::vector<MultistartStage> stages) {
  MultistartRules rules;
  rules.stages = std::move(stages);
  rules.last.steps = 200;
  return rules;
}

std::vector<Point> Points(const std::vector<double>& places) {
  std::vector<Point> points(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) points[k].x = places[k];
  return points;
}

Multistart<Point> RunFrom(const MultistartRules& rules, std::vector<Point> starts) {
  Multistart<Point> run;
  RunMultistart(rules, std::move(starts), Refine, Same, &run);
  return run;
}

Multistart<Point> RunFrom(const MultistartRules& rules, const std::vector<double>& places) {
  return RunFrom(rules, Points(places));
}

std::vector<int> Calls(const Multistart<Point>& run) {
  std::vector<int> calls;
  for (const Point& end : run.ends) calls.push_back(end.calls);
  return calls;
}

TEST(Multistart, EveryStageKeepsItsBest) {
  const Multistart<Point> run = RunFrom(Rules({{1, 3}, {2, 1}}), {4.3, 1.4, 3.3, 2.4, 0.3});
  EXPECT_THAT(Calls(run), ElementsAre(1, 2, 1, 2, 3));
  EXPECT_EQ(run.best, 4);
  EXPECT_NEAR(run.Best().value, 1, 1e-12);
  for (int k = 0; k < 5; ++k) EXPECT_EQ(run.ends[k].finished, k == 4) << k;
}

TEST(Multistart, TheFirstOfEachGroupGoOn) {
  std::vector<Point> starts = Points({0.1, 0.2, 0.3, 7.2, 7.3});
  starts[3].group = starts[4].group = 1;
  EXPECT_THAT(Calls(RunFrom(Rules({{1, 2}}), starts)), ElementsAre(2, 2, 1, 1, 1));
  MultistartRules rules = Rules({{1, 2, 0, 1}});
  EXPECT_THAT(Calls(RunFrom(rules, starts)), ElementsAre(2, 2, 1, 2, 1));
  rules.hopeless = 5;
  EXPECT_THAT(Calls(RunFrom(rules, starts)), ElementsAre(2, 2, 1, 1, 1));
  rules.stages[0].spare_hopeless = true;
  EXPECT_THAT(Calls(RunFrom(rules, starts)), ElementsAre(2, 2, 1, 2, 1));
}

TEST(Multistart, EndsThatCannotBeEvaluatedDoNotGoOn) {
  EXPECT_THAT(Calls(RunFrom(Rules({{1}}), {2000.1, 0.1, 3000.1})), ElementsAre(1, 2, 1));
}

TEST(Multistart, OnlyEndsNearTheBestAreFinished) {
  MultistartRules rules = Rules({{1}});
  rules.close = 2.5;
  EXPECT_THAT(Calls(RunFrom(rules, {0.1, 1.1, 2.1})), ElementsAre(2, 2, 1));
  rules.last.keep = 1;
  EXPECT_THAT(Calls(RunFrom(rules, {0.1, 1.1, 2.1})), ElementsAre(2, 1, 1));
}

TEST(Multistart, EndsThatEnterAlikeAreFinishedOnce) {
  MultistartRules rules = Rules({{1}});
  rules.apart = 0.1;  // they enter at 1.05, 1.1, 1.15 and 2.05
  const Multistart<Point> run = RunFrom(rules, {0.3, 0.2, 0.1, 1.1});
  EXPECT_THAT(Calls(run), ElementsAre(1, 1, 2, 2));
}

TEST(Multistart, EnoughVisitsOfTheBestOptimumEndIt) {
  MultistartRules rules = Rules({{1}});
  rules.visits = 2;
  std::vector<Point> starts = Points({0.1, 0.2, 0.3, 1.1, 2.1});
  starts[4].group = 1;  // of which the best optimum says nothing
  Multistart<Point> run = RunFrom(rules, starts);
  EXPECT_THAT(Calls(run), ElementsAre(2, 2, 1, 1, 2));
  EXPECT_EQ(Visits(run, Same), 2);
  // Earlier ends count.
  RunMultistart(rules, Points({0.3, 3.1}), Refine, Same, &run);
  EXPECT_THAT(Calls(run), ElementsAre(2, 2, 1, 1, 2, 1, 1));
  EXPECT_EQ(run.best, 0);
}

TEST(Multistart, AnEndAtTheBestOptimumIsAVisitWithoutARun) {
  const Multistart<Point> run = RunFrom(Rules({{100}}), {0.1, 0.2, 1.1, 1.2});
  EXPECT_THAT(Calls(run), ElementsAre(2, 1, 2, 2));
  EXPECT_EQ(Visits(run, Same), 2);
  EXPECT_THAT(FirstOfOptimum(run.ends, Same), ElementsAre(0, 0, 2, 2));
  const Multistart<Point> apart = RunFrom(Rules({{100, 2}}), {0.1, 2.1, 1.1});
  EXPECT_THAT(FirstOfOptimum(apart.ends, Same), ElementsAre(0, -1, 2));
}

TEST(Multistart, ValuesOfAnotherProblemAreForgotten) {
  MultistartRules rules = Rules({{1, 2, 0}});
  rules.last.problem = 1;
  const Multistart<Point> run = RunFrom(rules, {1.1, 0.1, 2.1});
  EXPECT_EQ(run.best, 1);
  EXPECT_NEAR(run.Best().value, 101, 1e-12);
  EXPECT_EQ(run.ends[2].value, HUGE_VAL);
}

TEST(Multistart, StopsAsTheObserverAsks) {
  const Observer stop_at_second = [](const Progress& progress) {
    return progress.iteration < 2 ? ObserverAction::kContinue : ObserverAction::kStop;
  };
  MultistartRules rules = Rules({{1}});
  rules.progress = ProgressReporter(stop_at_second, "test", 0);
  const Multistart<Point> run = RunFrom(rules, {3.1, 2.1, 1.1, 0.1});
  EXPECT_THAT(Calls(run), ElementsAre(1, 1, 0, 0));
  EXPECT_EQ(run.best, 1);
  // Something is returned even if the request comes first.
  const Observer stop = [](const Progress& /*any*/) { return ObserverAction::kStop; };
  rules = Rules({});
  rules.progress = ProgressReporter(stop, "test", 0);
  EXPECT_THAT(Calls(RunFrom(rules, {3.1, 2.1})), ElementsAre(1, 0));
}

TEST(Multistart, ThreadsDoNotChangeTheResult) {
  RandomStream random(1, 0);
  std::vector<double> places;
  for (int k = 0; k < 300; ++k) places.push_back(std::floor(40 * random.Uniform()) / 8);
  MultistartRules rules = Rules({{1, 100}, {3, 40}});
  rules.visits = 4;
  const Multistart<Point> one = RunFrom(rules, places);
  rules.threads = 4;
  const Multistart<Point> four = RunFrom(rules, places);
  EXPECT_EQ(one.best, four.best);
  EXPECT_EQ(Calls(one), Calls(four));
  std::vector<double> apart;
  for (std::size_t k = 0; k < places.size(); ++k) apart.push_back(one.ends[k].x - four.ends[k].x);
  EXPECT_THAT(apart, Each(0));
}

}  // namespace
}  // namespace lyrefit
