#include "lyrefit/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <string>
#include <thread>
#include <vector>

namespace lyrefit {
namespace {

#if defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__)
constexpr bool kHasThreads = false;  // memory is not shared between threads
#else
constexpr bool kHasThreads = true;
#endif

}  // namespace

Expected<void> ValidateThreads(int threads) {
  if (threads >= 0) return {};
  return Fail("threads = " + std::to_string(threads) + ", expected 0 (all cores) or more");
}

void ParallelFor(int count, int threads, const std::function<void(int)>& body) {
  if (threads <= 0) threads = std::max(1U, std::thread::hardware_concurrency());
  threads = kHasThreads ? std::min(threads, count) : 1;
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int i = next++; i < count; i = next++) body(i);
  };
  std::vector<std::thread> crew;
  for (int t = 1; t < threads; ++t) crew.emplace_back(work);
  work();
  for (std::thread& member : crew) member.join();
}

}  // namespace lyrefit
