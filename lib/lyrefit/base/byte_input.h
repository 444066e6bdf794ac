#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "lyrefit/base/error.h"

namespace lyrefit {

// Whether `path` names a source that can be read only once and in order: a pipe, a terminal or
// another device.
bool IsStream(const std::string& path);

// The error for a read that StoppableReads interrupted.
tl::unexpected<Error> FailAsStopped(const std::string& path);

// A file that is read once from its beginning; "-" stands for standard input. The destructor closes
// it.
class ByteInput {
 public:
  explicit ByteInput(std::string path) : path_(std::move(path)) {}
  ~ByteInput();
  ByteInput(const ByteInput&) = delete;
  ByteInput& operator=(const ByteInput&) = delete;

  // Reads up to `size` bytes into `to` and returns their number, 0 at the end. The first call opens
  // the file. Errors: the file cannot be opened or read; StoppableReads interrupted the read.
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
