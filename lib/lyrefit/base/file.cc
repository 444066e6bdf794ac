#include "lyrefit/base/file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string_view>
#include <system_error>

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

std::string ErrnoText(int number) { return std::generic_category().message(number); }

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

// Into the opened file; the error, if any, names `path`.
Expected<void> WriteAndClose(File file, const std::string& text, const std::string& path) {
  const bool written = std::fwrite(text.data(), 1, text.size(), file.get()) == text.size();
  const int write_errno = errno;
  if (!written) return Fail("cannot write the file: " + ErrnoText(write_errno), path);
  if (std::fclose(file.release()) != 0) {
    return Fail("cannot write the file: " + ErrnoText(errno), path);
  }
  return {};
}

// Pipes and terminals cannot be replaced by a rename, and /dev/stdout may stand for a regular file
// that the shell still holds open.
bool MustWriteInPlace(const fs::path& path) {
  const std::string text = path.string();
  if (StartsWith(text, "/dev/") || StartsWith(text, "/proc/")) return true;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_regular_file(status);
}

std::string TemporaryName(const fs::path& target) {
  static std::atomic<unsigned> count{0};
  return fmt::format("{}.{}-{}.tmp", target.string(), ::getpid(), count++);
}

}  // namespace

Expected<std::string> ReadTextFile(const std::string& path, std::uintmax_t largest_bytes) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) return Fail("the file does not exist", path);
  if (fs::is_directory(status)) return Fail("expected a file, found a folder", path);
  File file(std::fopen(path.c_str(), "rb"));
  if (!file) return Fail("cannot open the file: " + ErrnoText(errno), path);

  // In blocks, since pipes and devices do not tell their size.
  std::string text;
  if (fs::is_regular_file(status)) {
    const std::uintmax_t size = fs::file_size(path, error);
    if (!error && size <= largest_bytes) text.reserve(size);
  }
  std::array<char, 1 << 16> block;
  while (const std::size_t got = std::fread(block.data(), 1, block.size(), file.get())) {
    text.append(block.data(), got);
    if (text.size() > largest_bytes) {
      return Fail(fmt::format("the file is larger than the limit of {} bytes", largest_bytes),
                  path);
    }
  }
  if (std::ferror(file.get()) != 0) return Fail("cannot read the file: " + ErrnoText(errno), path);
  if (StartsWith(text, "\xef\xbb\xbf")) text.erase(0, 3);
  if (auto checked = CheckIsText(text, path); !checked) return tl::unexpected(checked.error());
  return text;
}

Expected<void> WriteTextFile(const std::string& path, const std::string& text) {
  std::error_code error;
  if (fs::is_directory(path, error)) return Fail("expected a file, found a folder", path);
  if (MustWriteInPlace(path)) {
    File file(std::fopen(path.c_str(), "ab"));
    if (!file) return Fail("cannot open the file for writing: " + ErrnoText(errno), path);
    return WriteAndClose(std::move(file), text, path);
  }
  // Through a symbolic link, so that the link survives.
  fs::path target = fs::weakly_canonical(path, error);
  if (error) target = path;
  const std::string temporary = TemporaryName(target);
  File file(std::fopen(temporary.c_str(), "wbx"));
  if (!file) {
    return Fail("cannot write into the folder of the file: " + ErrnoText(errno), path);
  }
  Expected<void> written = WriteAndClose(std::move(file), text, path);
  if (written) {
    const fs::file_status old = fs::status(target, error);
    if (fs::exists(old)) fs::permissions(temporary, old.permissions(), error);
    fs::rename(temporary, target, error);
    if (error) written = Fail("cannot replace the file: " + error.message(), path);
  }
  std::error_code ignored;
  if (!written) fs::remove(temporary, ignored);
  return written;
}

}  // namespace lyrefit
