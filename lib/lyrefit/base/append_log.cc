#include "lyrefit/base/append_log.h"

#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "lyrefit/base/try.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> Cannot(const char* verb, const LogKind& kind, const std::string& path) {
  return Fail(
      fmt::format("cannot {} the {}: {}", verb, kind.name, std::generic_category().message(errno)),
      path);
}

Expected<std::ifstream> OpenToRead(const std::string& path, const LogKind& kind) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return Cannot("read", kind, path);
  return in;
}

}  // namespace

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
  return line;
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
  std::int64_t whole = 0;
  while (true) {
    TRY(const auto line, in.Next());
    if (!line) break;
    TRY(take(*line, in.line()));
    whole += static_cast<std::int64_t>(line->size()) + 1;
  }
  torn_ = in.torn();
  if (torn_) return Cut(whole);
  end_ = whole;
  return {};
}

Expected<void> AppendLog::Cut(std::int64_t size) {
  if (ftruncate(file_.number(), size) != 0) return CannotWrite();
  end_ = size;
  return {};
}

Expected<void> AppendLog::Clear() { return Cut(0); }

Expected<void> AppendLog::Append(std::string_view lines) {
  if (!file_.Write(lines)) {
    const auto failed = CannotWrite();
    (void)Cut(end_);  // if this fails too, TakeUp of the next process cuts the text off
    return failed;
  }
  end_ += static_cast<std::int64_t>(lines.size());
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
