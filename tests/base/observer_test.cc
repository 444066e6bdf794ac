#include "lyrefit/base/observer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "lyrefit/base/parallel.h"

namespace lyrefit {
namespace {

TEST(ProgressReporter, TellsTheBeginningAndEveryJob) {
  std::vector<std::int64_t> heard;
  std::vector<double> parts;
  const Observer observer = [&](const Progress& progress) {
    EXPECT_EQ(progress.stage, "jobs");
    EXPECT_EQ(progress.iterations, 4);
    heard.push_back(progress.iteration);
    parts.push_back(progress.part);
    return ObserverAction::kContinue;
  };
  const ProgressReporter reporter(observer);
  reporter.BeginSilently("jobs", 4, 10);
  reporter.Count(1);
  reporter.Report();
  for (const double work : {2.0, 3.0, 4.0}) reporter.Step(work, 7);
  EXPECT_THAT(heard, testing::ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(parts, testing::ElementsAre(0.1, 0.3, 0.6, 1));
  EXPECT_FALSE(reporter.Stopped());
}

TEST(ProgressReporter, AsksOneThreadAtATimeAndStopsThemAll) {
  std::atomic<int> inside{0};
  int asked = 0;
  const Observer observer = [&](const Progress& /*progress*/) {
    EXPECT_EQ(++inside, 1);
    std::this_thread::yield();
    --inside;
    return ++asked > 50 ? ObserverAction::kStop : ObserverAction::kContinue;
  };
  const ProgressReporter reporter(observer, "jobs", 1000);
  std::atomic<int> done{0};
  ParallelFor(1000, 4, [&](int /*job*/) {
    if (reporter.Stopped()) return;
    ++done;
    reporter.Step();
  });
  EXPECT_TRUE(reporter.Stopped());
  EXPECT_EQ(asked, 51) << "not asked again after the stop";
  EXPECT_GT(done, 0);
  EXPECT_LE(done, 51 + 4) << "no thread begins another one";
}

TEST(ProgressReporter, AsksFromTheInsideOfAJobAtMostEveryFewMilliseconds) {
  int asked = 0;
  bool stop = false;
  const Observer observer = [&](const Progress& /*progress*/) {
    ++asked;
    return stop ? ObserverAction::kStop : ObserverAction::kContinue;
  };
  const ProgressReporter reporter(observer, "jobs", 1);
  const StopToken token = reporter.stop();
  const Observer inside = token.AsObserver();
  const auto begin = std::chrono::steady_clock::now();
  bool stopped = false;
  for (int i = 0; i < 100000; ++i)
    stopped = token.Stopped() || StopRequested(inside, {}) || stopped;
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
  EXPECT_FALSE(stopped);
  EXPECT_LE(asked, 1 + took.count() / 5) << "of 200000 times that it could have been";
  stop = true;
  while (!token.Stopped()) std::this_thread::yield();
  const int until_the_stop = asked;
  EXPECT_TRUE(StopRequested(inside, {}));
  for (int i = 0; i < 100000; ++i) EXPECT_TRUE(token.Stopped());
  EXPECT_EQ(asked, until_the_stop) << "not asked again after the stop";
}

TEST(ProgressReporter, NeverStopsWhereNobodyWatches) {
  const Observer nobody;
  const ProgressReporter silent(nobody, "jobs", 1);
  EXPECT_FALSE(silent.Step());
  EXPECT_FALSE(silent.Stopped());
  const ProgressReporter none;
  none.Begin("jobs", 1);
  EXPECT_FALSE(none.Step());
  EXPECT_FALSE(none.stop().AsObserver());
}

TEST(ProgressReporter, CountsToTheEndOfAStageAndBeginsTheNextAtZero) {
  std::vector<std::pair<std::string, std::int64_t>> heard;
  const Observer observer = [&](const Progress& progress) {
    heard.emplace_back(progress.stage, progress.iteration);
    return ObserverAction::kContinue;
  };
  const ProgressReporter reporter(observer, "first", 1);
  reporter.Count();
  reporter.Step();
  reporter.BeginSilently("second", 0);
  for (int i = 0; i < 3; ++i) reporter.Count();
  reporter.Step();
  using Heard = std::pair<std::string, std::int64_t>;
  EXPECT_THAT(heard,
              testing::ElementsAre(Heard("first", 0), Heard("first", 1), Heard("second", 4)));
}

TEST(StopToken, KeepsTheRequest) {
  int asked = 0;
  const StopToken token([&asked] { return ++asked == 2; });
  const StopToken copy = token;
  EXPECT_FALSE(token.Stopped());
  EXPECT_FALSE(copy.requested());
  EXPECT_TRUE(token.Stopped());
  EXPECT_TRUE(copy.requested());
  EXPECT_TRUE(copy.Stopped());
  EXPECT_EQ(asked, 2);
  const StopToken on_request(nullptr);
  EXPECT_FALSE(on_request.Stopped());
  on_request.Request();
  EXPECT_TRUE(on_request.Stopped());
  EXPECT_FALSE(StopToken().Stopped());
}

TEST(ValidateThreads, RefusesLessThanNone) {
  EXPECT_TRUE(ValidateThreads(0));
  EXPECT_TRUE(ValidateThreads(8));
  EXPECT_EQ(ValidateThreads(-3).error().message, "threads = -3, expected 0 (all cores) or more");
}

}  // namespace
}  // namespace lyrefit
