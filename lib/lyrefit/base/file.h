// Experimental: may change in a minor version (data/stable).
#pragma once

#include <cstdint>
#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Returns the bytes of a whole file, unchanged. Errors: the path does not exist or is a folder, the
// file is unreadable or larger than `largest_bytes`.
Expected<std::string> ReadFileBytes(const std::string& path, std::uintmax_t largest_bytes);

// Returns a whole file as text, without a UTF-8 byte order mark. Errors: those of ReadFileBytes; a
// file that is empty, UTF-16, or binary (contains a NUL byte).
Expected<std::string> ReadTextFile(const std::string& path, std::uintmax_t largest_bytes);

// Writes all of `text` or nothing. The text goes into an unnamed file that gets its name when
// complete, so a killed process leaves nothing behind. If the file system has no unnamed files, the
// text goes into NAME.PID-COUNT.tmp beside `path`. The next writer of `path` removes such files of
// dead processes. Errors, which leave an existing file unchanged, include a full disk and a file
// size limit.
Expected<void> WriteTextFile(const std::string& path, const std::string& text);

// Whether WriteTextFile can create or replace a file at `path`, or write into the device or pipe
// there; leaves no file behind. Errors: a folder; no permission.
Expected<void> CheckWritable(const std::string& path);

// Makes file reads interruptible. While an object lives, reads of its thread fail once `stop`
// requests it. The token is polled before every block, and ten times a second while a pipe has no
// data. It lets an observer stop a computation that is still reading.
class StoppableReads {
 public:
  // `stop` is polled only from the thread that constructs the object.
  explicit StoppableReads(StopToken stop);
  ~StoppableReads();
  StoppableReads(const StoppableReads&) = delete;             // tied to its thread
  StoppableReads& operator=(const StoppableReads&) = delete;  // tied to its thread

  // Whether a token of any object of the current thread requests a stop.
  static bool Stopped();

 private:
  StopToken stop_;
  StoppableReads* outer_;
};

}  // namespace lyrefit
