#include "interrupt.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "lyrefit/base/seconds.h"
#include "output.h"
#include "progress_text.h"

namespace lyrefit {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPeriod(200);  // between two updates of the line
constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t interrupted = 0;
std::atomic<bool> silent{false};

void EndNow(int /*signal*/) { _exit(kExitInterrupted); }

// Signals that the parent process ignores stay ignored.
void Catch(void (*handler)(int)) {
  for (const int signal : kSignals) {
    struct sigaction before = {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) std::signal(signal, handler);
  }
}

void OnInterrupt(int /*signal*/) {
  interrupted = 1;
  Catch(EndNow);
}

bool OnTerminal() { return isatty(STDERR_FILENO) != 0; }

void WipeLine() { TellError(fmt::format("\r{:<79}\r", "")); }

// Draws the line from a separate thread, so that it moves in stages without progress reports too.
class ProgressDisplay {
 public:
  explicit ProgressDisplay(ProgressStyle style) : style_(std::move(style)), text_(style_.whole) {
    if (!silent) drawer_ = std::thread([this] { Draw(); });
  }

  ~ProgressDisplay() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      over_ = true;
    }
    wake_.notify_all();
    if (drawer_.joinable()) drawer_.join();
    if (drawn_) WipeLine();
  }

  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  void Hear(const Progress& progress) {
    const std::lock_guard<std::mutex> lock(mutex_);
    text_.Hear(progress, Seconds());
  }

 private:
  double Seconds() const { return SecondsSince(begin_); }

  void Draw() {
    const bool terminal = OnTerminal();
    std::unique_lock<std::mutex> lock(mutex_);
    while (!wake_.wait_for(lock, kPeriod, [this] { return over_; })) {
      const std::string notice = interrupted != 0 ? "" : text_.LongRun(Seconds());
      if (!notice.empty()) {
        if (drawn_) WipeLine();
        TellError(fmt::format("lyrefit: {}; {}\n", notice, style_.on_interrupt));
      }
      if (terminal) {
        const std::string line = interrupted != 0 ? "stopping" : text_.Line(Seconds());
        if (line.empty()) continue;
        TellError(fmt::format("\r{:<79.79}", line));
        drawn_ = true;
      }
    }
    // Prints "stopping" also if the run ends before the next update.
    if (terminal && drawn_ && interrupted != 0) TellError(fmt::format("\r{:<79.79}", "stopping"));
  }

  const ProgressStyle style_;
  const Clock::time_point begin_ = Clock::now();
  std::mutex mutex_;  // guards the members below
  ProgressText text_;
  bool over_ = false;
  bool drawn_ = false;
  std::condition_variable wake_;
  std::thread drawer_;
};

}  // namespace

InterruptGuard::InterruptGuard() : reads_(StopToken(Interrupted)) {
  interrupted = 0;
  Catch(OnInterrupt);
}

InterruptGuard::~InterruptGuard() { EndOnSignals(); }

void EndOnSignals() { Catch(EndNow); }

void EndWithinASecond() {
  std::signal(SIGALRM, EndNow);
  alarm(1);
}

bool Interrupted() { return interrupted != 0; }

Observer TerminalObserver(ProgressStyle style) {
  return [display = std::make_shared<ProgressDisplay>(std::move(style))](const Progress& progress) {
    display->Hear(progress);
    return Interrupted() ? ObserverAction::kStop : ObserverAction::kContinue;
  };
}

void SilenceProgress() { silent = true; }

}  // namespace lyrefit
