#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "lyrefit/base/descriptor.h"
#include "lyrefit/base/error.h"

namespace lyrefit {

// A file that is written piece by piece and gets its name when it is complete. Until then, and
// after an error or a kill, an existing file of that name stays unchanged. The growing file has no
// name, so a killed process leaves nothing behind. If the file system has no unnamed files, its
// name is NAME.PID-COUNT.tmp. The next writer of NAME removes such files of dead processes. Devices
// and pipes cannot be replaced and are written directly.
class NewFile {
 public:
  explicit NewFile(std::string path);
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  // Errors of all functions: the path is a folder, the folder is not writable, the disk is full, or
  // the file size limit is reached. Each message names the path.
  Expected<void> Begin();
  Expected<void> Add(std::string_view text);
  // Passes all remaining text to the operating system and, with `on_disk`, waits until it is on the
  // disk.
  Expected<void> Complete(bool on_disk = false);
  // Gives the file its name. Call it after Complete.
  Expected<void> Name();

 private:
  tl::unexpected<Error> CannotWrite(int reason) const;
  Expected<void> OpenTemporary();
  Expected<void> CopyToTemporary();

  const std::string path_;
  std::filesystem::path target_;  // the file to replace; for a symbolic link its target
  Descriptor file_;
  std::string temporary_;  // name of the temporary file; empty if the file is unnamed or written in
                           // place
  bool in_place_ = false;
  std::string waiting_;
};

// Whether `path` must be written in place: a device, a pipe, or a path such as /dev/stdout that may
// stand for a file opened by the shell.
bool IsWrittenInPlace(const std::string& path);

}  // namespace lyrefit
