#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "lyrefit/base/descriptor.h"
#include "lyrefit/base/error.h"

namespace lyrefit {

// A file that is written piece by piece and gets its name when all of it is there. Until then, after
// an error, and after a kill the file of before stands under the name as it was. It has no name at
// all while it grows, so that nothing is left of it if the process is killed. Where the file system
// knows no such files it is NAME.PID-COUNT.tmp; the next one to write NAME removes what dead
// processes left. Devices and pipes cannot be replaced: they are written straight into.
class NewFile {
 public:
  explicit NewFile(std::string path);
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  // Errors of all: the path is a folder, the folder cannot be written, the disk is full, the limit
  // of the file size is reached. Each names the path.
  Expected<void> Begin();
  Expected<void> Add(std::string_view text);
  // All of it is with the operating system; with `on_disk` also on the disk.
  Expected<void> Complete(bool on_disk = false);
  // Gives it its name, after Complete.
  Expected<void> Name();

 private:
  tl::unexpected<Error> CannotWrite(int reason) const;
  Expected<void> OpenTemporary();
  Expected<void> CopyToTemporary();

  const std::string path_;
  std::filesystem::path target_;  // of a symbolic link the file that it leads to
  Descriptor file_;
  std::string temporary_;  // empty: the file has no name, or is written in place
  bool in_place_ = false;
  std::string waiting_;
};

// Whether `path` is a device or a pipe, or may stand for a file that the shell holds open.
bool IsWrittenInPlace(const std::string& path);

}  // namespace lyrefit
