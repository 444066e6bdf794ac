#pragma once

#include <fcntl.h>
#include <pthread.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"

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

// A file that is written piece by piece and gets its name when it is complete, as WriteTextFile
// does (file.h). Until then, and after an error or a kill, an existing file of that name stays
// unchanged. Devices and pipes cannot be replaced and are written directly.
class NewFile {
 public:
  explicit NewFile(std::string path);
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  // Errors of all functions: the path is a folder, the folder is not writable, the disk is full, or
  // the file size limit is reached. Each message names the path.
  Expected<void> Begin();
  Expected<void> Write(std::string_view text);
  // Gives the complete file its name.
  Expected<void> Commit();
  // Gives no file its name before all are complete and on the disk.
  static Expected<void> Commit(const std::vector<NewFile*>& files);

 private:
  tl::unexpected<Error> CannotWrite(int reason) const;
  Expected<void> Flush();
  Expected<void> Complete(bool on_disk);
  Expected<void> Name();
  Expected<void> OpenTemporary();
  Expected<void> WriteFrom(const Descriptor& other);  // all content of an open file
  Expected<void> CopyToTemporary();

  const std::string path_;
  std::filesystem::path target_;  // the file to replace; for a symbolic link its target
  Descriptor file_;
  std::string temporary_;  // name of the temporary file; empty if the file is unnamed or written in
                           // place
  bool in_place_ = false;
  std::string waiting_;
};

}  // namespace lyrefit
