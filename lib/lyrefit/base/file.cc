#include "lyrefit/base/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include "lyrefit/base/byte_input.h"
#include "lyrefit/base/new_file.h"
#include "lyrefit/base/try.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

bool StartsWith(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

Expected<void> CheckIsText(const std::string& text, const std::string& path) {
  if (text.empty()) return Fail("the file is empty", path);
  if (StartsWith(text, "\xff\xfe") || StartsWith(text, "\xfe\xff")) {
    return Fail("expected UTF-8 text, found UTF-16: save the file as UTF-8", path);
  }
  if (std::memchr(text.data(), '\0', text.size()) != nullptr) {
    return Fail("expected text, found a binary file (it holds a zero byte)", path);
  }
  return {};
}

}  // namespace

Expected<std::string> ReadFileBytes(const std::string& path, std::uintmax_t largest_bytes) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) return Fail("the file does not exist", path);
  if (fs::is_directory(status)) return Fail("expected a file, found a folder", path);
  // Reads in blocks, since pipes and devices do not report their size.
  std::string text;
  if (fs::is_regular_file(status)) {
    const std::uintmax_t size = fs::file_size(path, error);
    if (!error && size <= largest_bytes) text.reserve(size);
  }
  ByteInput file(path == "-" ? "./-" : path);  // "./-" is the file of that name, "-" would be
                                               // standard input
  std::array<char, 1 << 16> block;
  for (;;) {
    TRY(const std::size_t got, file.Read(block.data(), block.size()));
    if (got == 0) return text;
    text.append(block.data(), got);
    if (text.size() > largest_bytes) {
      return Fail(fmt::format("the file is larger than the limit of {} bytes", largest_bytes),
                  path);
    }
  }
}

Expected<std::string> ReadTextFile(const std::string& path, std::uintmax_t largest_bytes) {
  Expected<std::string> text = ReadFileBytes(path, largest_bytes);
  if (!text) return text;
  if (StartsWith(*text, "\xef\xbb\xbf")) text->erase(0, 3);
  TRY(CheckIsText(*text, path));
  return text;
}

namespace {

namespace fs = std::filesystem;

constexpr char kTemporaryEnd[] = ".tmp";
// A temporary file whose process does not run on this machine may belong to another machine. It
// counts as abandoned once it has not been written for this long.
constexpr std::chrono::minutes kStale(1);
constexpr std::size_t kWriteAt = std::size_t{1} << 18;  // bytes collected before a write

// Name of a temporary file, such as "curve.json.4711-0.tmp" for process 4711.
std::string TemporaryName(const fs::path& target) {
  static std::atomic<unsigned> count{0};
  return fmt::format("{}.{}-{}{}", target.string(), ::getpid(), count++, kTemporaryEnd);
}

// The process that wrote the temporary file `name` of `target`; 0 if `name` is no such file.
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

// Removes temporary files of `target` that killed processes left.
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

// Copies the permissions of an existing file at `target`.
void TakePermissions(const fs::path& target, int file) {
  struct stat old;
  if (::stat(target.c_str(), &old) == 0) ::fchmod(file, old.st_mode & 07777);
}

// Opens an unnamed file in `folder`; -1 if the system or file system has none.
int OpenNameless(const fs::path& folder) {
#ifdef O_TMPFILE
  if (::access("/proc/self/fd", X_OK) == 0) {
    return ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
  }
#endif
  return -1;
}

bool GiveName(const Descriptor& nameless, const std::string& name) {
  const std::string file = fmt::format("/proc/self/fd/{}", nameless.number());
  return ::linkat(AT_FDCWD, file.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
}

fs::path FolderOf(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

int OpenScratchIn(const fs::path& folder) {
  const int nameless = OpenNameless(folder);
  if (nameless >= 0) return nameless;
  const std::string name = TemporaryName(folder / "lyrefit");
  const int number = ::open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (number >= 0) ::unlink(name.c_str());
  return number;
}

// Whether `path` must be written in place: a device, a pipe, or a path such as /dev/stdout that may
// stand for a file opened by the shell.
bool IsWrittenInPlace(const std::string& path) {
  const bool device = path.rfind("/dev/", 0) == 0 && path.rfind("/dev/shm/", 0) != 0;
  if (device || path.rfind("/proc/", 0) == 0) return true;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_regular_file(status);
}

// Opens a file that is written in place; -1 if that fails. A pipe has no reader yet: waits for one
// as reads wait for a writer, so that a stop ends it.
int OpenInPlace(const std::string& path) {
  constexpr int kHow = O_WRONLY | O_APPEND | O_CLOEXEC;
  if (!IsStream(path)) return ::open(path.c_str(), kHow);
  for (;;) {
    const int file = ::open(path.c_str(), kHow | O_NONBLOCK);
    if (file >= 0) ::fcntl(file, F_SETFL, kHow);
    if (file >= 0 || errno != ENXIO || StoppableReads::Stopped()) return file;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
}

tl::unexpected<Error> CannotWriteFile(const std::string& path, int reason) {
  return Fail("cannot write the file: " + std::generic_category().message(reason), path);
}

}  // namespace

NewFile::NewFile(std::string path) : path_(std::move(path)), file_(-1) {}

NewFile::~NewFile() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

tl::unexpected<Error> NewFile::CannotWrite(int reason) const {
  return CannotWriteFile(path_, reason);
}

Expected<void> NewFile::Begin() {
  std::error_code error;
  if (fs::is_directory(path_, error)) return Fail("expected a file, found a folder", path_);
  in_place_ = IsWrittenInPlace(path_);
  if (in_place_) {
    file_.Reset(OpenInPlace(path_));
    if (file_.open()) return {};
    return Fail("cannot open the file for writing: " + std::generic_category().message(errno),
                path_);
  }
  // The link's target is replaced, so that a symbolic link stays a link.
  target_ = fs::weakly_canonical(path_, error);
  if (error) target_ = path_;
  const fs::path folder = FolderOf(target_);
  RemoveStale(folder, target_.filename().string());
  file_.Reset(OpenNameless(folder));
  if (!file_.open()) TRY(OpenTemporary());
  TakePermissions(target_, file_.number());
  return {};
}

// For file systems without unnamed files.
Expected<void> NewFile::OpenTemporary() {
  const std::string name = TemporaryName(target_);
  file_.Reset(::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (!file_.open()) {
    return Fail(
        "cannot write into the folder of the file: " + std::generic_category().message(errno),
        path_);
  }
  temporary_ = name;
  return {};
}

Expected<void> NewFile::Write(std::string_view text) {
  waiting_ += text;
  return waiting_.size() < kWriteAt ? Expected<void>() : Flush();
}

Expected<void> NewFile::Flush() {
  if (!file_.Write(waiting_)) return CannotWrite(errno);
  waiting_.clear();
  return {};
}

Expected<void> NewFile::WriteFrom(const Descriptor& other) {
  std::string block(kWriteAt, '\0');
  ::lseek(other.number(), 0, SEEK_SET);
  for (ssize_t got = 0; (got = ::read(other.number(), block.data(), block.size())) != 0;) {
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return CannotWrite(errno);
    TRY(Write(std::string_view(block).substr(0, static_cast<std::size_t>(got))));
  }
  return {};
}

Expected<void> NewFile::Complete(bool on_disk) {
  TRY(Flush());
  if (on_disk && fdatasync(file_.number()) != 0 && errno != EINVAL) return CannotWrite(errno);
  const bool nameless = temporary_.empty() && !in_place_;  // closing would delete it
  return nameless || file_.Close() ? Expected<void>() : CannotWrite(errno);
}

// Copies an unnamed file that cannot be linked into a named temporary file.
Expected<void> NewFile::CopyToTemporary() {
  const Descriptor nameless(::dup(file_.number()));
  TRY(OpenTemporary());
  TakePermissions(target_, file_.number());
  TRY(WriteFrom(nameless));
  return Complete(false);
}

Expected<void> NewFile::Name() {
  if (in_place_) return {};
  if (temporary_.empty()) {
    if (GiveName(file_, target_.string())) return {};
    const std::string name = TemporaryName(target_);
    if (errno == EEXIST && GiveName(file_, name)) {
      temporary_ = name;
    } else {
      TRY(CopyToTemporary());
    }
  }
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) return Fail("cannot replace the file: " + error.message(), path_);
  temporary_.clear();
  return {};
}

Expected<void> NewFile::Commit() {
  TRY(Complete(false));
  return Name();
}

Expected<void> NewFile::Commit(const std::vector<NewFile*>& files) {
  for (NewFile* file : files) TRY(file->Complete(true));
  for (NewFile* file : files) TRY(file->Name());
  return {};
}

Expected<void> WriteTextFile(const std::string& path, const std::string& text) {
  NewFile file(path);
  TRY(file.Begin());
  TRY(file.Write(text));
  return file.Commit();
}

Expected<void> CheckWritable(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) return Fail("expected a file to write, found a folder", path);
  if (fs::exists(status)) {
    if (::access(path.c_str(), W_OK) != 0) return CannotWriteFile(path, errno);
    if (!fs::is_regular_file(status)) return {};
  }
  const Descriptor probe(OpenScratchIn(FolderOf(path)));
  return probe.open() ? Expected<void>() : CannotWriteFile(path, errno);
}

}  // namespace lyrefit
