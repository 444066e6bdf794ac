#pragma once

#include <fcntl.h>
#include <pthread.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <ctime>
#include <string_view>

// Files as the operating system has them, for the .cc that write them.
namespace lyrefit {

// A file size limit sends a signal that ends the program. While this lives, the thread gets the
// error of the write instead.
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

// An open file; closed at the end of its life at the latest.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { Close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  // Closes what it held.
  void Reset(int number) {
    Close();
    number_ = number;
  }

  bool open() const { return number_ >= 0; }
  int number() const { return number_; }

  // Whether all of `text` was taken; else errno says why not, also at a limit of the file size.
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
