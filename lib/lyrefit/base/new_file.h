#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/descriptor.h"
#include "lyrefit/base/error.h"

namespace lyrefit {

// A file that is written piece by piece and gets its name when it is complete, as WriteTextFile
// does (file.h). Until then, and after an error or a kill, an existing file of that name stays
// unchanged. Devices and pipes cannot be replaced and are written directly.
class NewFile {
 public:
  explicit NewFile(std::string path);
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  // Errors of all functions: the path is a folder, the folder is not writable, the disk is full, or
  // the file size limit is reached. Each message names the path.
  Expected<void> Begin();
  Expected<void> Write(std::string_view text);
  // Gives the complete file its name.
  Expected<void> Commit();
  // Gives no file its name before all are complete and on the disk.
  static Expected<void> Commit(const std::vector<NewFile*>& files);

 private:
  tl::unexpected<Error> CannotWrite(int reason) const;
  Expected<void> Flush();
  Expected<void> Complete(bool on_disk);
  Expected<void> Name();
  Expected<void> OpenTemporary();
  Expected<void> WriteFrom(const Descriptor& other);  // all content of an open file
  Expected<void> CopyToTemporary();

  const std::string path_;
  std::filesystem::path target_;  // the file to replace; for a symbolic link its target
  Descriptor file_;
  std::string temporary_;  // name of the temporary file; empty if the file is unnamed or written in
                           // place
  bool in_place_ = false;
  std::string waiting_;
};

}  // namespace lyrefit
