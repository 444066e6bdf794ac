#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/byte_input.h"
#include "lyrefit/base/error.h"

namespace lyrefit {

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
