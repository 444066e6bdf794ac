#include "lyrefit/base/shared_observer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <vector>

#include "lyrefit/base/parallel.h"

namespace lyrefit {
namespace {

TEST(SharedObserver, TellsTheBeginningAndEveryJob) {
  std::vector<std::int64_t> heard;
  std::vector<double> parts;
  const Observer observer = [&](const Progress& progress) {
    EXPECT_EQ(progress.stage, "jobs");
    EXPECT_EQ(progress.iterations, 4);
    heard.push_back(progress.iteration);
    parts.push_back(progress.part);
    return ObserverAction::kContinue;
  };
  SharedObserver shared(observer, "jobs", 4, 10);
  shared.SkipJob(1);
  shared.Begin();
  for (const double work : {2.0, 3.0, 4.0}) shared.FinishJob(work, 7);
  EXPECT_THAT(heard, testing::ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(parts, testing::ElementsAre(0.1, 0.3, 0.6, 1));
  EXPECT_FALSE(shared.Stopped());
}

TEST(SharedObserver, AsksOneThreadAtATimeAndStopsThemAll) {
  std::atomic<int> inside{0};
  int asked = 0;
  const Observer observer = [&](const Progress& /*progress*/) {
    EXPECT_EQ(++inside, 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    --inside;
    return ++asked > 50 ? ObserverAction::kStop : ObserverAction::kContinue;
  };
  SharedObserver shared(observer, "jobs", 1000);
  shared.Begin();
  std::atomic<int> done{0};
  ParallelFor(1000, 4, [&](int /*job*/) {
    if (shared.Stopped()) return;
    ++done;
    shared.FinishJob();
  });
  EXPECT_TRUE(shared.Stopped());
  EXPECT_EQ(asked, 51) << "not asked again after the stop";
  EXPECT_GT(done, 0);
  EXPECT_LE(done, 51 + 4) << "no thread begins another one";
}

TEST(SharedObserver, AsksFromTheInsideOfAJobAtMostEveryFewMilliseconds) {
  int asked = 0;
  bool stop = false;
  const Observer observer = [&](const Progress& /*progress*/) {
    ++asked;
    return stop ? ObserverAction::kStop : ObserverAction::kContinue;
  };
  SharedObserver shared(observer, "jobs", 1);
  const std::function<bool()> proceed = shared.Proceed();
  const Observer inside = shared.Inside();
  const auto begin = std::chrono::steady_clock::now();
  bool stopped = false;
  for (int i = 0; i < 100000; ++i) stopped = !proceed() || StopRequested(inside, {}) || stopped;
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
  EXPECT_FALSE(stopped);
  EXPECT_LE(asked, 1 + took.count() / 5) << "of 200000 times that it could have been";
  stop = true;
  while (proceed()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const int until_the_stop = asked;
  EXPECT_TRUE(StopRequested(inside, {}));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_FALSE(proceed());
  EXPECT_EQ(asked, until_the_stop) << "not asked again after the stop";
}

TEST(SharedObserver, NeverStopsWhereNobodyWatches) {
  const Observer nobody;
  SharedObserver shared(nobody, "jobs", 1);
  EXPECT_FALSE(shared.Inside());
  EXPECT_FALSE(shared.Proceed());
  shared.FinishJob();
  EXPECT_FALSE(shared.Stopped());
}

TEST(ValidateThreads, RefusesLessThanNone) {
  EXPECT_TRUE(ValidateThreads(0));
  EXPECT_TRUE(ValidateThreads(8));
  EXPECT_EQ(ValidateThreads(-3).error().message, "threads = -3, expected 0 (all cores) or more");
}

}  // namespace
}  // namespace lyrefit
