#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"

namespace lyrefit {

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
  std::string path_;
  int descriptor_ = -1;
};

// A line without its end, LF or CRLF.
struct ScannedLine {
  std::string_view text;    // until the next one is asked for
  std::int64_t offset = 0;  // where it begins in the file
  std::int64_t end = 0;     // where the next one begins
  std::int64_t number = 0;  // from 1
  bool too_long = false;    // `text` is but its beginning
};

// The lines of a file, in blocks of a megabyte; a byte order mark is left out. Of a line longer
// than `longest` bytes the beginning is kept.
class LineScanner {
 public:
  LineScanner(std::string path, std::size_t longest);

  // False at the end.
  Expected<bool> Next(ScannedLine* line);

  // The first bytes of the file, a block at most. To be asked for before the first line.
  Expected<std::string_view> Head();

 private:
  Expected<void> Fill();
  Expected<void> SkipLine();

  ByteInput file_;
  std::size_t longest_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0;  // of what is not yet given
  std::size_t end_ = 0;    // of what was read
  std::int64_t offset_ = 0;
  std::int64_t number_ = 0;
  bool over_ = false;
};

}  // namespace lyrefit
