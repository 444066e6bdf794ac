#include "lyrefit/stream/line_scanner.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "lyrefit/base/try.h"

namespace lyrefit {
namespace {

constexpr std::size_t kFirstBlock = 1U << 16;
constexpr std::size_t kBlock = 1U << 20;
constexpr std::size_t kKeptOfLongLine = 4096;  // bytes; the id of a row is usually at its beginning
constexpr std::string_view kMarkOfUtf8 = "\xef\xbb\xbf";

}  // namespace

LineScanner::LineScanner(std::string path, std::size_t longest)
    : file_(std::move(path)), longest_(std::max(longest, kKeptOfLongLine)) {}

// Moves the unused bytes to the front and reads more. The buffer grows with the length of the line.
Expected<void> LineScanner::Fill() {
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  // A small first block, since many files are small.
  if (buffer_.size() == end_) {
    buffer_.resize(buffer_.empty() ? kFirstBlock : std::max(kBlock, 2 * end_));
  }
  TRY(const std::size_t got, file_.Read(buffer_.data() + end_, buffer_.size() - end_));
  over_ = got == 0;
  end_ += got;
  return {};
}

Expected<std::string_view> LineScanner::Head() {
  while (!over_ && end_ < kBlock) TRY(Fill());
  return std::string_view(buffer_.data(), end_);
}

// Skips the rest of a long line, keeps its beginning and releases the memory.
Expected<void> LineScanner::SkipLine() {
  offset_ += static_cast<std::int64_t>(end_ - begin_);
  std::vector<char> kept(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
                         buffer_.begin() + static_cast<std::ptrdiff_t>(begin_ + kKeptOfLongLine));
  buffer_ = std::vector<char>(kKeptOfLongLine + kBlock);
  std::copy(kept.begin(), kept.end(), buffer_.begin());
  const auto fresh = buffer_.data() + kKeptOfLongLine;
  for (;;) {
    TRY(const std::size_t got, file_.Read(fresh, kBlock));
    over_ = got == 0;
    const void* const stop = std::memchr(fresh, '\n', got);
    const std::size_t used =
        stop == nullptr ? got : static_cast<const char*>(stop) - fresh + std::size_t{1};
    offset_ += static_cast<std::int64_t>(used);
    begin_ = kKeptOfLongLine + used;
    end_ = kKeptOfLongLine + got;
    if (stop != nullptr || over_) return {};
  }
}

Expected<bool> LineScanner::Next(ScannedLine* line) {
  if (number_ == 0) {
    TRY(const std::string_view head, Head());
    if (head.substr(0, kMarkOfUtf8.size()) == kMarkOfUtf8) {
      begin_ = kMarkOfUtf8.size();
      offset_ = static_cast<std::int64_t>(begin_);
    }
  }
  line->offset = offset_;
  line->number = ++number_;
  line->too_long = false;
  std::size_t looked = 0;  // number of bytes already searched for the line end
  for (;;) {
    const char* const from = buffer_.data() + begin_;
    const void* const stop = std::memchr(from + looked, '\n', end_ - begin_ - looked);
    looked = end_ - begin_;
    if (stop == nullptr && !over_ && looked <= longest_) {
      TRY(Fill());
      continue;
    }
    const std::size_t length =
        stop == nullptr ? looked : static_cast<std::size_t>(static_cast<const char*>(stop) - from);
    if (length > longest_) {
      if (stop == nullptr) {
        TRY(SkipLine());
        line->text = std::string_view(buffer_.data(), kKeptOfLongLine);
      } else {
        line->text = std::string_view(from, kKeptOfLongLine);
        begin_ += length + 1;
        offset_ += static_cast<std::int64_t>(length + 1);
      }
      line->too_long = true;
      line->end = offset_;
      return true;
    }
    if (stop == nullptr && length == 0) return false;
    line->text = std::string_view(from, length);
    const std::size_t used = length + (stop == nullptr ? 0 : 1);
    begin_ += used;
    offset_ += static_cast<std::int64_t>(used);
    line->end = offset_;
    if (!line->text.empty() && line->text.back() == '\r') line->text.remove_suffix(1);
    return true;
  }
}

}  // namespace lyrefit
