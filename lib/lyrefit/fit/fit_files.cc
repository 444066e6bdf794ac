#include "lyrefit/fit/fit_files.h"

#include <chrono>
#include <mutex>
#include <optional>

#include "lyrefit/base/parallel.h"
#include "lyrefit/base/seconds.h"
#include "lyrefit/base/stoppable_reads.h"

namespace lyrefit {
namespace {

// Counts finished files for one observer that several threads share.
class Watch {
 public:
  Watch(std::size_t files, const Observer& observer)
      : files_(static_cast<std::int64_t>(files)), observer_(observer) {}

  bool stopped() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return stopped_;
  }

  bool Stop() { return Report(0); }
  void FileDone() { Report(1); }

  // Observer for the fit of one file: ignores its progress and forwards a stop request.
  Observer ForOneFile() {
    return [this](const Progress&) {
      return Stop() ? ObserverAction::kStop : ObserverAction::kContinue;
    };
  }

 private:
  bool Report(int finished) {
    const std::lock_guard<std::mutex> lock(mutex_);
    done_ += finished;
    Progress progress;
    progress.stage = "fit";
    progress.iteration = done_;
    progress.iterations = files_;
    progress.seconds = SecondsSince(begin_);
    stopped_ = StopRequested(observer_, progress) || stopped_;
    return stopped_;
  }

  const std::int64_t files_;
  const Observer& observer_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::int64_t done_ = 0;
  bool stopped_ = false;
};

}  // namespace

std::vector<FittedFile> FitFiles(
    const std::vector<std::string>& files, int threads, const Observer& observer,
    const std::function<Expected<FitReport>(int i, const Observer& observer)>& fit) {
  Watch watch(files.size(), observer);
  std::vector<std::optional<Expected<FitReport>>> reports(files.size());
  ParallelFor(static_cast<int>(files.size()), threads, [&](int i) {
    if (watch.stopped()) return;
    const StoppableReads reads([&watch] { return watch.Stop(); });
    reports[i] = fit(i, watch.ForOneFile());
    if (watch.stopped() && !*reports[i]) reports[i].reset();  // its error may come from the stop
    watch.FileDone();
  });
  std::vector<FittedFile> fits;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (reports[i]) fits.push_back({files[i], std::move(*reports[i])});
  }
  return fits;
}

}  // namespace lyrefit
