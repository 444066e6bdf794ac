#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "lyrefit/base/descriptor.h"
#include "lyrefit/base/error.h"

namespace lyrefit {

// A file of lines that grows while a run goes on, so that a run that was stopped or killed can be
// taken up again. One process writes it at a time.
class AppendLog {
 public:
  // How sentences name a log, and how its first line begins.
  struct Kind {
    const char* name;   // "journal", in "cannot write the journal"
    const char* these;  // "this journal", in "another process is writing this journal"
    const char* one;    // "a journal", in "expected a journal"
    const char* begin;  // of the first line
    const char* other;  // the sentence where a file of another kind stands there
  };

  // Opens `path` or creates it, and locks it. Errors: a file that cannot be written, that is no
  // regular file, or that another process writes.
  static Expected<std::unique_ptr<AppendLog>> Open(const std::string& path, const Kind& kind);

  const std::string& path() const { return path_; }
  bool empty() const { return end_ == 0; }  // nothing stands in it

  // Hands every whole line, without its end, and its number from 1 to `take`. A last line without an
  // end was never finished: it is cut off. Errors, and nothing is cut: a first line of another kind
  // of file; those of `take`.
  Expected<void> TakeUp(const std::function<Expected<void>(const std::string&, int)>& take);
  bool torn() const { return torn_; }  // TakeUp cut off a last line

  // Removes all that stands in it.
  Expected<void> Clear();
  // Writes whole lines, each with its end. They are with the operating system when it returns, so a
  // killed process loses none. What could not be written whole is taken back.
  Expected<void> Append(std::string_view lines);
  // Waits until all is on the disk.
  Expected<void> Sync();
  // Removes the file.
  Expected<void> Remove();

 private:
  AppendLog(std::string path, const Kind& kind, int file)
      : path_(std::move(path)), kind_(kind), file_(file) {}
  Expected<void> Lock();
  Expected<void> Cut(std::int64_t size);
  tl::unexpected<Error> CannotWrite() const;

  const std::string path_;
  const Kind kind_;
  const Descriptor file_;
  std::int64_t end_ = 0;  // of the last whole line
  bool torn_ = false;
};

}  // namespace lyrefit
