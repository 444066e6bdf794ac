#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/byte_input.h"
#include "lyrefit/base/error.h"

namespace lyrefit {

// A line without its line end, LF or CRLF.
struct ScannedLine {
  std::string_view text;    // valid until the next call of Next()
  std::int64_t offset = 0;  // position of its first byte in the file
  std::int64_t end = 0;     // position of the next line
  std::int64_t number = 0;  // from 1
  bool too_long = false;    // `text` is only the beginning of the line
};

// Reads the lines of a file in blocks of a megabyte. A byte order mark is skipped. Of a line longer
// than `longest` bytes only the beginning is kept.
class LineScanner {
 public:
  LineScanner(std::string path, std::size_t longest);

  // False at the end of the file.
  Expected<bool> Next(ScannedLine* line);

  // The first bytes of the file, at most one block. Must be called before the first Next().
  Expected<std::string_view> Head();

 private:
  Expected<void> Fill();
  Expected<void> SkipLine();

  ByteInput file_;
  std::size_t longest_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0;  // position of the first unused byte in `buffer_`
  std::size_t end_ = 0;    // end of the bytes in `buffer_`
  std::int64_t offset_ = 0;
  std::int64_t number_ = 0;
  bool over_ = false;
};

}  // namespace lyrefit
