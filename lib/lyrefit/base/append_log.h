#pragma once

#include <cstdint>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "lyrefit/base/error.h"
#include "lyrefit/base/new_file.h"

namespace lyrefit {

// Words that error messages use for a log, and the text that its first line begins with.
struct LogKind {
  const char* name;   // "journal", in "cannot write the journal"
  const char* these;  // "this journal", in "another process is writing this journal"
  const char* one;    // "a journal", in "expected a journal"
  const char* begin;  // the first line starts with this text
  const char* other;  // the error message if the first line starts with another text
  // Advice of the error at a wrong checksum. Null: lines of this kind have no checksums.
  const char* advice = nullptr;
  // The error message for a log without checksums, as older programs wrote it. Null: it is read.
  const char* unsealed = nullptr;
  // A first line that starts with this text has a checksum. Null: any that has none is read.
  const char* sealed_begin = nullptr;
};

// Running checksums over the lines of a log, each a JSON object or list. The last member of every
// line, "crc", or the last element, is the CRC-32 of this and all earlier lines. A reader thus
// detects a line that was changed, moved or lost.
class LineSums {
 public:
  // `line`, without its line end, with its checksum added as the last member.
  std::string Seal(std::string_view line);
  // `line` without its checksum; empty if that is missing or wrong.
  std::optional<std::string> Check(std::string_view line);

 private:
  std::uint32_t Add(std::string_view line);

  std::uint32_t remainder_ = 0xFFFFFFFF;  // of all lines so far
};

// Reads the lines of a log in order.
class LogReader {
 public:
  // Errors: no file that can be read; a pipe or device.
  static Expected<LogReader> Open(const std::string& path, const LogKind& kind);

  const std::string& path() const { return path_; }
  // The next complete line, without its line end and checksum. Empty after the last. Errors: the
  // first line does not start with `LogKind::begin`; a wrong checksum; the file cannot be read.
  Expected<std::optional<std::string>> Next();
  int line() const { return line_; }   // number of the last line read, from 1; 0 before the first
  bool torn() const { return torn_; }  // at the end: the last line has no line end
  std::int64_t bytes() const { return bytes_; }  // of the complete lines so far
  bool sealed() const { return sealed_; }        // the lines have checksums
  const LineSums& sums() const { return sums_; }

 private:
  LogReader(std::string path, const LogKind& kind, std::ifstream in)
      : path_(std::move(path)), kind_(kind), in_(std::move(in)) {}

  std::string path_;
  LogKind kind_;
  std::ifstream in_;
  LineSums sums_;
  int line_ = 0;
  std::int64_t bytes_ = 0;
  bool torn_ = false;
  bool sealed_ = false;
};

// The last line of the log at `path`. Empty if it has no line end or more than 4096 bytes.
Expected<std::optional<std::string>> LastLine(const std::string& path, const LogKind& kind);

// A line-based file that a run extends while it works, so that a stopped or killed run can be
// resumed from it. Only one process writes the file at a time.
class AppendLog {
 public:
  // Opens `path` or creates it, and locks it. Errors: a file that cannot be written, that is no
  // regular file, or that another process writes.
  static Expected<std::unique_ptr<AppendLog>> Open(const std::string& path, const LogKind& kind);

  const std::string& path() const { return path_; }
  bool empty() const { return end_ == 0; }  // the file has no content

  // Passes every complete line, without its line end and checksum, and its line number (from 1) to
  // `take`. A last line without a line end was never finished and is cut off. Errors, which cut
  // nothing off: those of LogReader and of `take`.
  Expected<void> TakeUp(const std::function<Expected<void>(const std::string&, int)>& take);
  bool torn() const { return torn_; }  // TakeUp cut off an unfinished last line

  // Empties the file.
  Expected<void> Clear();
  // Writes `lines`, which must be complete lines with their line ends, each with its checksum if the
  // kind has them; to a log that was begun without them, without. On return the operating
  // system has the text, so a killed process loses none of it. A partly written text is removed
  // again.
  Expected<void> Append(std::string_view lines);
  // Returns once all content is on the disk.
  Expected<void> Sync();
  // Deletes the file.
  Expected<void> Remove();

 private:
  AppendLog(std::string path, const LogKind& kind, int file)
      : path_(std::move(path)), kind_(kind), file_(file), sealed_(kind.advice != nullptr) {}
  Expected<void> Lock();
  Expected<void> Cut(std::int64_t size);
  tl::unexpected<Error> CannotWrite() const;

  const std::string path_;
  const LogKind kind_;
  const Descriptor file_;
  LineSums sums_;
  bool sealed_;
  std::int64_t end_ = 0;  // bytes up to the end of the last complete line
  bool torn_ = false;
};

}  // namespace lyrefit
