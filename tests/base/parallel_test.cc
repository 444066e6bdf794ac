#include "lyrefit/base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

namespace lyrefit {
namespace {

TEST(ParallelForTest, RunsEveryBodyOnceWithAnyNumberOfThreads) {
  for (const int threads : {0, 1, 2, 3, 8, 1000}) {
    SCOPED_TRACE(threads);
    std::vector<int> runs(257);
    ParallelFor(static_cast<int>(runs.size()), threads, [&](int i) { ++runs[i]; });
    for (const int count : runs) EXPECT_EQ(count, 1);
  }
}

TEST(ParallelForTest, ReturnsAtOnceWithoutBodies) {
  int runs = 0;
  ParallelFor(0, 4, [&](int) { ++runs; });
  EXPECT_EQ(runs, 0);
}

TEST(ParallelForTest, UsesNoMoreThreadsThanAsked) {
  std::mutex mutex;
  std::set<std::thread::id> seen;
  ParallelFor(1000, 2, [&](int) {
    const std::lock_guard<std::mutex> lock(mutex);
    seen.insert(std::this_thread::get_id());
  });
  EXPECT_LE(seen.size(), 2U);
  seen.clear();
  ParallelFor(100, 1, [&](int) { seen.insert(std::this_thread::get_id()); });
  EXPECT_EQ(seen, std::set<std::thread::id>{std::this_thread::get_id()});
}

TEST(ParallelForTest, IsDoneWhenItReturns) {
  std::atomic<int> done{0};
  ParallelFor(50, 4, [&](int) {
    std::this_thread::yield();
    ++done;
  });
  EXPECT_EQ(done, 50);
}

}  // namespace
}  // namespace lyrefit
