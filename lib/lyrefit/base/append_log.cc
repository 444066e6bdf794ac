#include "lyrefit/base/append_log.h"

#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "lyrefit/base/try.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> Refusal(const AppendLog::Kind& kind, int reason, const std::string& path) {
  return Fail(
      fmt::format("cannot write the {}: {}", kind.name, std::generic_category().message(reason)),
      path);
}

}  // namespace

Expected<std::unique_ptr<AppendLog>> AppendLog::Open(const std::string& path, const Kind& kind) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    return Fail(fmt::format("expected {}, or a file that does not exist yet", kind.one), path);
  }
  const int number = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (number < 0) return Refusal(kind, errno, path);
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
  std::ifstream in(path_, std::ios::binary);
  if (!in) {
    return Fail(
        fmt::format("cannot read the {}: {}", kind_.name, std::generic_category().message(errno)),
        path_);
  }
  const std::string begin = kind_.begin;
  std::int64_t whole = 0;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    torn_ = in.eof();  // the line has no line end
    if (++number == 1) {
      const std::size_t length = torn_ ? std::min(begin.size(), line.size()) : begin.size();
      if (line.compare(0, length, begin, 0, length) != 0) return Fail(kind_.other, path_, 1);
    }
    if (torn_) return Cut(whole);
    TRY(take(line, number));
    whole += static_cast<std::int64_t>(line.size()) + 1;
  }
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

tl::unexpected<Error> AppendLog::CannotWrite() const { return Refusal(kind_, errno, path_); }

}  // namespace lyrefit
