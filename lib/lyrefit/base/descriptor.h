#pragma once

#include <fcntl.h>
#include <pthread.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <ctime>
#include <string_view>

// File descriptors of the operating system, for the .cc files that write to them.
namespace lyrefit {

// Turns the file size limit into an error. Reaching the limit raises SIGXFSZ, which ends the
// program by default. While an object lives, its thread blocks the signal and the write fails
// instead.
class LimitIsAnError {
 public:
  LimitIsAnError() {
    sigemptyset(&limit_);
    sigaddset(&limit_, SIGXFSZ);
    pthread_sigmask(SIG_BLOCK, &limit_, &before_);
  }
  ~LimitIsAnError() {
    const int reason = errno;
    const timespec at_once{};
    while (sigtimedwait(&limit_, nullptr, &at_once) == SIGXFSZ) continue;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    errno = reason;
  }
  LimitIsAnError(const LimitIsAnError&) = delete;
  LimitIsAnError& operator=(const LimitIsAnError&) = delete;

 private:
  sigset_t limit_;
  sigset_t before_;
};

// An open file, which the destructor closes unless Close did.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { Close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  // Closes the current file and takes over the file descriptor `number`.
  void Reset(int number) {
    Close();
    number_ = number;
  }

  bool open() const { return number_ >= 0; }
  int number() const { return number_; }

  // Writes `text`. Returns false unless all of it was written, with the reason in errno, also at a
  // limit of the file size.
  bool Write(std::string_view text) const {
    const LimitIsAnError guard;
    while (!text.empty()) {
      const ssize_t taken = ::write(number_, text.data(), text.size());
      if (taken < 0 && errno == EINTR) continue;
      if (taken < 0) return false;
      text.remove_prefix(static_cast<std::size_t>(taken));
    }
    return true;
  }

  bool Close() {
    const int number = number_;
    number_ = -1;
    return number < 0 || ::close(number) == 0;
  }

 private:
  int number_;
};

}  // namespace lyrefit
