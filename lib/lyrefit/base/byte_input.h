#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "lyrefit/base/error.h"

namespace lyrefit {

// Whether `path` names what can be read once, from its beginning to its end: a pipe, a terminal, a
// device.
bool IsStream(const std::string& path);

// The error of reading that was asked to stop (StoppableReads).
tl::unexpected<Error> FailAsStopped(const std::string& path);

// A file that is read once from its beginning, "-" for standard input. Closed at the end of its
// life.
class ByteInput {
 public:
  explicit ByteInput(std::string path) : path_(std::move(path)) {}
  ~ByteInput();
  ByteInput(const ByteInput&) = delete;
  ByteInput& operator=(const ByteInput&) = delete;

  // Up to `size` bytes into `to`; 0 at the end. Opens the file when first called.
  Expected<std::size_t> Read(char* to, std::size_t size);
  const std::string& path() const { return path_; }

 private:
  Expected<void> Open();
  Expected<void> AwaitBytes() const;

  std::string path_;
  int descriptor_ = -1;
  bool stream_ = false;
};

}  // namespace lyrefit
