#pragma once

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace faults {

// Calls body(0) .. body(count - 1) on as many threads, 0: one per processor. Each call must write only
// to its own slot.
template <class Body>
void ForEach(int count, int threads, const Body& body) {
  if (threads <= 0) threads = static_cast<int>(std::thread::hardware_concurrency());
  std::atomic<int> next{0};
  std::vector<std::thread> workers;
  for (int t = 0; t < std::max(1, std::min(threads, count)); ++t) {
    workers.emplace_back([&] {
      for (int i = next++; i < count; i = next++) body(i);
    });
  }
  for (std::thread& worker : workers) worker.join();
}

}  // namespace faults
