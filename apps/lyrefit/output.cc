#include "output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "lyrefit/base/file.h"
#include "lyrefit/report/readable.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> CannotWrite(const std::string& path, int reason) {
  return Fail("cannot write the file: " + std::generic_category().message(reason), path);
}

}  // namespace

void TellError(const std::string& text) {
  const std::string readable = Readable(text);
  std::fwrite(readable.data(), 1, readable.size(), stderr);
  std::fflush(stderr);
}

int Refuse(const Error& error) {
  TellError("lyrefit: " + error.ToString() + "\n");
  return kExitBadInput;
}

void PrintRemarks(const std::vector<std::string>& remarks) {
  for (const std::string& remark : remarks) TellError("lyrefit: " + remark + "\n");
}

Expected<void> CheckWritable(const std::string& path) {
  if (path.empty() || path == "-") return {};
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) return Fail("expected a file to write, found a folder", path);
  if (fs::exists(status)) {
    if (access(path.c_str(), W_OK) != 0) return CannotWrite(path, errno);
    if (!fs::is_regular_file(status)) return {};
  }
  // Opens a temporary file in the folder, as the writer does: without a name if the file system
  // supports it.
#ifdef O_TMPFILE
  const fs::path folder = fs::path(path).parent_path();
  const int nameless =
      open(folder.empty() ? "." : folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
  if (nameless >= 0) {
    close(nameless);
    return {};
  }
#endif
  const std::string probe = fmt::format("{}.{}.probe", path, getpid());
  const int file = open(probe.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (file < 0) return CannotWrite(path, errno);
  close(file);
  unlink(probe.c_str());
  return {};
}

Expected<void> WriteOutput(const std::string& path, const std::string& text) {
  if (path != "-") return WriteTextFile(path, text);
  const std::string readable = Readable(text);
  const bool written =
      std::fwrite(readable.data(), 1, readable.size(), stdout) == readable.size() &&
      std::fflush(stdout) == 0;
  if (!written) return CannotWrite("standard output", errno);
  return {};
}

}  // namespace lyrefit
