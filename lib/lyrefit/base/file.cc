#include "lyrefit/base/file.h"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "lyrefit/base/byte_input.h"
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

}  // namespace lyrefit
