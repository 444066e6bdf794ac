#include "lyrefit/base/append_log.h"

#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <boost/crc.hpp>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "lyrefit/base/byte_input.h"
#include "lyrefit/base/try.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> Cannot(const char* verb, const LogKind& kind, const std::string& path) {
  return Fail(
      fmt::format("cannot {} the {}: {}", verb, kind.name, std::generic_category().message(errno)),
      path);
}

// End of a line with a checksum: ,"crc":"0123abcd"} or ,"0123abcd"]
constexpr std::string_view kSumOfObject = ",\"crc\":\"", kSumOfList = ",\"";
constexpr std::size_t kSumDigits = 8;

std::string_view SumBegin(std::string_view line) {
  return line.back() == ']' ? kSumOfList : kSumOfObject;
}

// Where the checksum of a line begins; npos: it has none.
std::size_t SumOf(std::string_view line) {
  if (line.empty()) return std::string_view::npos;
  const std::string_view begin = SumBegin(line);
  const std::size_t size = begin.size() + kSumDigits + 2;
  if (line.size() < size) return std::string_view::npos;
  const std::string_view sum = line.substr(line.size() - size);
  const std::string_view digits = sum.substr(begin.size(), kSumDigits);
  const bool is_sum = sum.substr(0, begin.size()) == begin && sum[size - 2] == '"' &&
                      digits.find_first_not_of("0123456789abcdef") == std::string_view::npos;
  return is_sum ? line.size() - size : std::string_view::npos;
}

Expected<std::ifstream> OpenToRead(const std::string& path, const LogKind& kind) {
  // Opening a pipe would wait for its writer.
  if (IsStream(path)) {
    return Fail(fmt::format("expected a file with {}, found a pipe or a device", kind.one), path);
  }
  std::ifstream in(path, std::ios::binary);
  if (!in) return Cannot("read", kind, path);
  return in;
}

}  // namespace

std::uint32_t LineSums::Add(std::string_view line) {
  boost::crc_32_type sum(remainder_);
  sum.process_bytes(line.data(), line.size());
  sum.process_byte('\n');
  remainder_ = sum.get_interim_remainder();
  return sum.checksum();
}

std::string LineSums::Seal(std::string_view line) {
  return fmt::format("{}{}{:08x}\"{}", line.substr(0, line.size() - 1), SumBegin(line), Add(line),
                     line.back());
}

std::optional<std::string> LineSums::Check(std::string_view line) {
  const std::size_t begin = SumOf(line);
  if (begin == std::string_view::npos) return std::nullopt;
  std::string plain(line.substr(0, begin));
  plain += line.back();
  if (Seal(plain) != line) return std::nullopt;
  return plain;
}

Expected<LogReader> LogReader::Open(const std::string& path, const LogKind& kind) {
  TRY(std::ifstream in, OpenToRead(path, kind));
  return LogReader(path, kind, std::move(in));
}

Expected<std::optional<std::string>> LogReader::Next() {
  std::string line;
  if (!std::getline(in_, line)) {
    if (in_.bad()) return Cannot("read", kind_, path_);
    return std::nullopt;
  }
  torn_ = in_.eof();
  if (++line_ == 1) {
    const std::string_view begin = kind_.begin;
    const std::size_t length = torn_ ? std::min(begin.size(), line.size()) : begin.size();
    if (line.compare(0, length, begin.substr(0, length)) != 0) return Fail(kind_.other, path_, 1);
  }
  if (torn_) return std::nullopt;
  bytes_ += static_cast<std::int64_t>(line.size()) + 1;
  if (kind_.advice == nullptr) return line;
  const bool has_sum = SumOf(line) != std::string_view::npos;
  if (line_ == 1) sealed_ = has_sum;
  if (line_ == 1 && !sealed_ && kind_.unsealed != nullptr) return Fail(kind_.unsealed, path_, 1);
  const bool lost = kind_.sealed_begin != nullptr && line.rfind(kind_.sealed_begin, 0) == 0;
  if (line_ == 1 && !sealed_ && lost) {
    return Fail(fmt::format("this line has lost its checksum; {}", kind_.advice), path_, 1);
  }
  if (!sealed_ && !has_sum) return line;
  std::optional<std::string> plain = sums_.Check(line);
  if (sealed_ && plain) return plain;
  return Fail(fmt::format("the checksum of this line is not that of what stands up to here: a line "
                          "was changed, moved or lost; {}",
                          kind_.advice),
              path_, line_);
}

Expected<std::optional<std::string>> LastLine(const std::string& path, const LogKind& kind) {
  constexpr std::streamoff kLongest = 4096;
  TRY(std::ifstream in, OpenToRead(path, kind));
  in.seekg(0, std::ios::end);
  const std::streamoff size = std::min<std::streamoff>(in.tellg(), kLongest + 2);
  if (size < 0) return Cannot("read", kind, path);
  in.seekg(-size, std::ios::end);
  std::string text(static_cast<std::size_t>(size), '\0');
  if (!in.read(text.data(), size)) return Cannot("read", kind, path);
  if (text.empty() || text.back() != '\n') return std::nullopt;
  text.pop_back();
  text.erase(0, text.rfind('\n') + 1);
  if (text.size() > kLongest) return std::nullopt;
  return text;
}

Expected<std::unique_ptr<AppendLog>> AppendLog::Open(const std::string& path, const LogKind& kind) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    return Fail(fmt::format("expected {}, or a file that does not exist yet", kind.one), path);
  }
  const int number = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (number < 0) return Cannot("write", kind, path);
  std::unique_ptr<AppendLog> log(new AppendLog(path, kind, number));
  TRY(log->Lock());
  return log;
}

Expected<void> AppendLog::Lock() {
  if (flock(file_.number(), LOCK_EX | LOCK_NB) != 0) {
    return Fail(fmt::format("another process is writing {}", kind_.these), path_);
  }
  struct stat held = {};
  if (fstat(file_.number(), &held) != 0) return CannotWrite();
  // The other process may have finished and removed the file between open and lock.
  if (held.st_nlink == 0) {
    return Fail(fmt::format("another process has just finished {}", kind_.these), path_);
  }
  end_ = held.st_size;
  return {};
}

Expected<void> AppendLog::TakeUp(
    const std::function<Expected<void>(const std::string&, int)>& take) {
  TRY(LogReader in, LogReader::Open(path_, kind_));
  while (true) {
    TRY(const auto line, in.Next());
    if (!line) break;
    TRY(take(*line, in.line()));
  }
  torn_ = in.torn();
  sums_ = in.sums();
  if (in.bytes() > 0) sealed_ = in.sealed();
  if (torn_) return Cut(in.bytes());
  end_ = in.bytes();
  return {};
}

Expected<void> AppendLog::Cut(std::int64_t size) {
  if (ftruncate(file_.number(), size) != 0) return CannotWrite();
  end_ = size;
  return {};
}

Expected<void> AppendLog::Clear() {
  sums_ = LineSums();
  sealed_ = kind_.advice != nullptr;
  return Cut(0);
}

Expected<void> AppendLog::Append(std::string_view lines) {
  LineSums sums = sums_;
  std::string text;
  for (std::size_t begin = 0, end = 0; begin < lines.size(); begin = end + 1) {
    end = lines.find('\n', begin);
    const std::string_view line = lines.substr(begin, end - begin);
    text += sealed_ ? sums.Seal(line) : std::string(line);
    text += '\n';
  }
  if (!file_.Write(text)) {
    const auto failed = CannotWrite();
    (void)Cut(end_);  // if this fails too, TakeUp of the next process cuts the text off
    return failed;
  }
  sums_ = sums;
  end_ += static_cast<std::int64_t>(text.size());
  return {};
}

Expected<void> AppendLog::Sync() {
  if (fdatasync(file_.number()) != 0 && errno != EINVAL) return CannotWrite();
  return {};
}

Expected<void> AppendLog::Remove() {
  if (unlink(path_.c_str()) != 0) return CannotWrite();
  return {};
}

tl::unexpected<Error> AppendLog::CannotWrite() const { return Cannot("write", kind_, path_); }

}  // namespace lyrefit
