#include "lyrefit/batch/pipeline.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "lyrefit/base/file.h"

namespace lyrefit {
namespace {

constexpr std::chrono::milliseconds kLook(100);  // interval between two checks whether to stop
constexpr std::int64_t kAhead = 32;  // number of curves for each worker between reader and writer

class Crew {
 public:
  Crew(const Pipeline& pipeline, BatchSource* source)
      : pipeline_(pipeline), source_(source), read_(pipeline.skip), written_(pipeline.skip) {
    int threads = pipeline.threads;
    if (threads <= 0) threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    ahead_ = kAhead * threads;
    crew_.emplace_back([this] { Read(); });
    for (int t = 0; t < threads; ++t) crew_.emplace_back([this] { Work(); });
  }
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;
  ~Crew() {
    Stop();
    for (std::thread& member : crew_) member.join();
  }

  Expected<PipelineEnd> Write();

 private:
  struct Done {
    PipelineStep step;
    std::int64_t end = 0;
  };

  void Stop() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      stop_.Request();
    }
    changed_.notify_all();
  }
  void Read();
  void Work();
  bool TakeReady(std::string* texts, std::int64_t* rows, PipelineProgress* progress);

  const Pipeline& pipeline_;
  BatchSource* const source_;
  std::int64_t ahead_ = 0;
  const StopToken stop_{nullptr};
  std::mutex mutex_;  // guards the members below
  std::condition_variable changed_;
  std::int64_t read_;     // number of curves passed on by the reader, including those skipped
  std::int64_t written_;  // number of curves taken by the writer, including those skipped
  bool all_read_ = false;
  std::optional<Error> failure_;  // error of the source
  PipelineEnd end_;
  std::deque<std::pair<std::int64_t, BatchItem>> waiting_;
  std::map<std::int64_t, Done> done_;
  std::vector<std::thread> crew_;
};

void Crew::Read() {
  const StoppableReads reads(stop_);
  for (std::int64_t place = 0;; ++place) {
    Expected<std::optional<BatchItem>> item = source_->Next();
    std::unique_lock<std::mutex> lock(mutex_);
    if (!item) failure_ = item.error();
    if (!item || !*item || stop_.requested()) {
      all_read_ = true;
      changed_.notify_all();
      return;
    }
    end_.last = PipelinePlace{(*item)->input, (*item)->number};
    if (place == 0) end_.first = end_.last;
    if (place < pipeline_.skip) continue;
    waiting_.emplace_back(place, std::move(**item));
    read_ = place + 1;
    changed_.notify_all();
    changed_.wait(lock, [this] { return stop_.requested() || read_ - written_ < ahead_; });
  }
}

void Crew::Work() {
  const StoppableReads reads(stop_);
  while (true) {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return stop_.requested() || !waiting_.empty() || all_read_; });
    if (stop_.requested() || waiting_.empty()) return;
    auto [place, item] = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    PipelineStep step = pipeline_.work(item, stop_);
    lock.lock();
    done_.emplace(place, Done{std::move(step), item.end});
    lock.unlock();
    changed_.notify_all();
  }
}

// Takes all finished rows that are next in order. The mutex must be held. False: the next row was
// interrupted.
bool Crew::TakeReady(std::string* texts, std::int64_t* rows, PipelineProgress* progress) {
  while (!done_.empty() && done_.begin()->first == written_) {
    Done& next = done_.begin()->second;
    if (next.step.interrupted) return false;
    *texts += next.step.text;
    ++*rows;
    progress->broken += next.step.broken ? 1 : 0;
    progress->end = next.end;
    done_.erase(done_.begin());
    ++written_;
  }
  return true;
}

Expected<PipelineEnd> Crew::Write() {
  PipelineProgress progress;
  while (true) {
    std::string texts;
    std::int64_t rows = 0;
    bool whole = true;
    bool over = false;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait_for(lock, kLook, [this] {
        return (!done_.empty() && done_.begin()->first == written_) ||
               (all_read_ && written_ == read_);
      });
      whole = TakeReady(&texts, &rows, &progress);
      over = all_read_ && written_ == read_;
    }
    if (rows > 0) {
      changed_.notify_all();
      if (auto written = pipeline_.write(texts, rows); !written) {
        return tl::unexpected(written.error());
      }
      progress.rows += rows;
    }
    if (over) break;
    if (!whole || (pipeline_.stop && pipeline_.stop(progress))) return PipelineEnd();
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  if (failure_) return tl::unexpected(*failure_);
  end_.complete = true;
  return end_;
}

}  // namespace

Expected<PipelineEnd> Run(const Pipeline& pipeline, BatchSource* source) {
  Crew crew(pipeline, source);
  return crew.Write();
}

}  // namespace lyrefit
