#include "lyrefit/base/byte_input.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "lyrefit/base/file.h"
#include "lyrefit/base/try.h"

namespace lyrefit {
namespace {

constexpr int kLook_ms = 100;  // period of calls to StoppableReads::Stopped

thread_local StoppableReads* innermost = nullptr;

std::string ErrnoText() { return std::generic_category().message(errno); }

}  // namespace

bool IsStream(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_other(path, error);
}

tl::unexpected<Error> FailAsStopped(const std::string& path) {
  return Fail("stopped before the end of it was read", path);
}

StoppableReads::StoppableReads(StopToken stop)
    : stop_(std::move(stop)), outer_(std::exchange(innermost, this)) {}

StoppableReads::~StoppableReads() { innermost = outer_; }

bool StoppableReads::Stopped() {
  for (const StoppableReads* one = innermost; one != nullptr; one = one->outer_) {
    if (one->stop_.Stopped()) return true;
  }
  return false;
}

ByteInput::~ByteInput() {
  if (descriptor_ > STDIN_FILENO) ::close(descriptor_);
}

// Opens a pipe without waiting for its writer; AwaitBytes waits.
Expected<void> ByteInput::Open() {
  stream_ = path_ == "-" || IsStream(path_);
  const int without_waiting = stream_ ? O_NONBLOCK | O_NOCTTY : 0;
  descriptor_ =
      path_ == "-" ? STDIN_FILENO : ::open(path_.c_str(), O_RDONLY | O_CLOEXEC | without_waiting);
  if (descriptor_ < 0) return Fail("cannot open the file: " + ErrnoText(), path_);
  return {};
}

// Waits for data or the end of the stream. Regular files, and streams that poll cannot wait for,
// are read without waiting.
Expected<void> ByteInput::AwaitBytes() const {
  for (;;) {
    if (StoppableReads::Stopped()) return FailAsStopped(path_);
    if (!stream_) return {};
    pollfd waiting = {descriptor_, POLLIN, 0};
    const int ready = ::poll(&waiting, 1, kLook_ms);
    if (ready > 0 || (ready < 0 && errno != EINTR)) return {};
  }
}

Expected<std::size_t> ByteInput::Read(char* to, std::size_t size) {
  if (descriptor_ < 0) TRY(Open());
  for (;;) {
    TRY(AwaitBytes());
    const ssize_t got = ::read(descriptor_, to, size);
    if (got >= 0) return static_cast<std::size_t>(got);
    if (errno == EINTR || errno == EAGAIN) continue;
    return Fail("cannot read the file: " + ErrnoText(), path_);
  }
}

}  // namespace lyrefit
