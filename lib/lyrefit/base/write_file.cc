#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "lyrefit/base/descriptor.h"
#include "lyrefit/base/file.h"
#include "lyrefit/base/try.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

constexpr char kTemporaryEnd[] = ".tmp";
// A temporary file of a process that lives nowhere on this machine may be another machine's; not so
// if nobody has written into it for that long.
constexpr std::chrono::minutes kStale(1);

tl::unexpected<Error> CannotWrite(int reason, const std::string& path) {
  return Fail("cannot write the file: " + std::generic_category().message(reason), path);
}

// Pipes and terminals cannot be replaced by a rename, and /dev/stdout may stand for a regular file
// that the shell still holds open.
bool MustWriteInPlace(const fs::path& path) {
  const std::string text = path.string();
  const bool device = text.rfind("/dev/", 0) == 0 && text.rfind("/dev/shm/", 0) != 0;
  if (device || text.rfind("/proc/", 0) == 0) return true;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_regular_file(status);
}

Expected<void> WriteInPlace(const std::string& path, const std::string& text) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
  if (!file.open()) {
    return Fail("cannot open the file for writing: " + std::generic_category().message(errno),
                path);
  }
  if (!file.Write(text) || !file.Close()) return CannotWrite(errno, path);
  return {};
}

// "curve.json.4711-0.tmp" for process 4711.
std::string TemporaryName(const fs::path& target) {
  static std::atomic<unsigned> count{0};
  return fmt::format("{}.{}-{}{}", target.string(), ::getpid(), count++, kTemporaryEnd);
}

// The process that wrote `name`, a temporary file of `target`; 0 if it is not one.
pid_t OwnerOf(std::string_view name, const std::string& target) {
  if (name.rfind(target + ".", 0) != 0) return 0;
  name.remove_prefix(target.size() + 1);
  pid_t owner = 0;
  const char* const end = name.data() + name.size();
  const auto number = std::from_chars(name.data(), end, owner);
  unsigned count = 0;
  if (number.ec != std::errc() || number.ptr == end || *number.ptr != '-') return 0;
  const auto counter = std::from_chars(number.ptr + 1, end, count);
  if (counter.ec != std::errc()) return 0;
  return std::string_view(counter.ptr, end - counter.ptr) == kTemporaryEnd ? owner : 0;
}

// Removes what killed processes have left of this target.
void RemoveStale(const fs::path& folder, const std::string& target) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const pid_t owner = OwnerOf(entry->path().filename().string(), target);
    if (owner <= 0 || ::kill(owner, 0) == 0 || errno != ESRCH) continue;
    std::error_code unknown;
    const fs::file_time_type written = entry->last_write_time(unknown);
    if (unknown || fs::file_time_type::clock::now() - written < kStale) continue;
    fs::remove(entry->path(), unknown);
  }
}

// As an old file at `target`, if there is one.
void TakePermissions(const fs::path& target, int file) {
  struct stat old;
  if (::stat(target.c_str(), &old) == 0) ::fchmod(file, old.st_mode & 07777);
}

Expected<void> Replace(const std::string& temporary, const fs::path& target,
                       const std::string& path) {
  std::error_code error;
  fs::rename(temporary, target, error);
  if (!error) return {};
  const std::string reason = error.message();
  fs::remove(temporary, error);
  return Fail("cannot replace the file: " + reason, path);
}

// Gives a name to a file that has none: nothing of it is left if the process is killed before.
// False where the file system cannot.
Expected<bool> Name(const Descriptor& file, const fs::path& target, const std::string& path) {
  const std::string nameless = fmt::format("/proc/self/fd/{}", file.number());
  const auto link = [&](const std::string& name) {
    return ::linkat(AT_FDCWD, nameless.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
  };
  if (link(target.string())) return true;
  const std::string temporary = TemporaryName(target);
  if (errno != EEXIST || !link(temporary)) return false;
  TRY(Replace(temporary, target, path));
  return true;
}

// Where the file system knows no files without names.
Expected<void> WriteNamed(const fs::path& target, const std::string& path,
                          const std::string& text) {
  const std::string temporary = TemporaryName(target);
  Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (!file.open()) {
    return Fail(
        "cannot write into the folder of the file: " + std::generic_category().message(errno),
        path);
  }
  TakePermissions(target, file.number());
  if (file.Write(text) && file.Close()) return Replace(temporary, target, path);
  const int reason = errno;
  ::unlink(temporary.c_str());
  return CannotWrite(reason, path);
}

// A file without a name in `folder`; not open where there is no such thing.
int OpenNameless(const fs::path& folder) {
#ifdef O_TMPFILE
  if (::access("/proc/self/fd", X_OK) == 0) {
    return ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  }
#endif
  return -1;
}

}  // namespace

Expected<void> WriteTextFile(const std::string& path, const std::string& text) {
  std::error_code error;
  if (fs::is_directory(path, error)) return Fail("expected a file, found a folder", path);
  const LimitIsAnError guard;
  if (MustWriteInPlace(path)) return WriteInPlace(path, text);
  // Through a symbolic link, so that the link survives.
  fs::path target = fs::weakly_canonical(path, error);
  if (error) target = path;
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  RemoveStale(folder, target.filename().string());
  const Descriptor nameless(OpenNameless(folder));
  if (!nameless.open()) return WriteNamed(target, path, text);
  TakePermissions(target, nameless.number());
  if (!nameless.Write(text)) return CannotWrite(errno, path);
  const Expected<bool> named = Name(nameless, target, path);
  if (!named) return tl::unexpected(named.error());
  return *named ? Expected<void>() : WriteNamed(target, path, text);
}

}  // namespace lyrefit
