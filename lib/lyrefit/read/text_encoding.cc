#include "lyrefit/read/text_encoding.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "lyrefit/base/file.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"

namespace lyrefit {
namespace {

bool StartsWith(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

void AppendUtf8(char32_t code, std::string* text) {
  const auto add = [text](char32_t byte) { *text += static_cast<char>(byte); };
  if (code < 0x80) return add(code);
  if (code < 0x800) {
    add(0xc0 | (code >> 6));
  } else if (code < 0x10000) {
    add(0xe0 | (code >> 12));
    add(0x80 | ((code >> 6) & 0x3f));
  } else {
    add(0xf0 | (code >> 18));
    add(0x80 | ((code >> 12) & 0x3f));
    add(0x80 | ((code >> 6) & 0x3f));
  }
  add(0x80 | (code & 0x3f));
}

// Characters 0x80 to 0x9f, where Windows-1252 differs from Latin-1; 0 for the five undefined codes.
constexpr char32_t kWindows1252[32] = {
    0x20ac, 0,      0x201a, 0x0192, 0x201e, 0x2026, 0x2020, 0x2021, 0x02c6, 0x2030, 0x0160,
    0x2039, 0x0152, 0,      0x017d, 0,      0,      0x2018, 0x2019, 0x201c, 0x201d, 0x2022,
    0x2013, 0x2014, 0x02dc, 0x2122, 0x0161, 0x203a, 0x0153, 0,      0x017e, 0x0178};

std::string FromWindows1252(std::string_view bytes) {
  std::string text;
  text.reserve(bytes.size() + bytes.size() / 8);
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    const char32_t code = byte >= 0x80 && byte < 0xa0 ? kWindows1252[byte - 0x80] : byte;
    AppendUtf8(code == 0 ? 0xfffd : code, &text);
  }
  return text;
}

enum class ByteOrder { kLittle, kBig };

// Unpaired surrogates become the replacement character; an odd last byte is dropped.
std::string FromUtf16(std::string_view bytes, ByteOrder order) {
  const auto unit = [&](std::size_t at) -> char32_t {
    const auto first = static_cast<unsigned char>(bytes[at]);
    const auto second = static_cast<unsigned char>(bytes[at + 1]);
    return order == ByteOrder::kLittle ? first | second << 8 : first << 8 | second;
  };
  std::string text;
  text.reserve(bytes.size() / 2);
  for (std::size_t at = 0; at + 1 < bytes.size(); at += 2) {
    char32_t code = unit(at);
    const bool high = code >= 0xd800 && code < 0xdc00;
    const char32_t low = high && at + 3 < bytes.size() ? unit(at + 2) : 0;
    if (low >= 0xdc00 && low < 0xe000) {
      code = 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00);
      at += 2;
    } else if (code >= 0xd800 && code < 0xe000) {
      code = 0xfffd;
    }
    AppendUtf8(code, &text);
  }
  return text;
}

// Guesses the byte order of UTF-16 without a byte order mark. Tables consist mostly of digits, and
// every digit has one zero byte, always on the same side.
std::optional<ByteOrder> GuessUtf16(std::string_view bytes) {
  constexpr std::size_t kLooked = 4096;
  const std::string_view start = bytes.substr(0, kLooked);
  std::size_t zeros[2] = {0, 0};
  for (std::size_t i = 0; i < start.size(); ++i) zeros[i % 2] += start[i] == '\0' ? 1 : 0;
  const std::size_t enough = start.size() / 4;
  if (start.size() < 4) return std::nullopt;
  if (zeros[0] == 0 && zeros[1] > enough) return ByteOrder::kLittle;
  if (zeros[1] == 0 && zeros[0] > enough) return ByteOrder::kBig;
  return std::nullopt;
}

}  // namespace

Expected<DecodedText> DecodeText(std::string bytes, const std::string& path) {
  if (StartsWith(bytes, "PK\x03\x04")) {
    return Fail(
        "expected text, found a zip archive, such as an Excel workbook: save the sheet as CSV",
        path);
  }
  DecodedText decoded;
  std::optional<ByteOrder> order;
  std::string_view units = bytes;
  if (StartsWith(bytes, "\xff\xfe")) order = ByteOrder::kLittle;
  if (StartsWith(bytes, "\xfe\xff")) order = ByteOrder::kBig;
  if (order) {
    units.remove_prefix(2);
  } else {
    order = GuessUtf16(bytes);
  }
  if (order) {
    decoded.text = FromUtf16(units, *order);
    decoded.remark = "the file is written in UTF-16: decoded";
  } else {
    decoded.text = std::move(bytes);
  }
  if (StartsWith(decoded.text, "\xef\xbb\xbf")) decoded.text.erase(0, 3);
  if (decoded.text.empty()) return Fail("the file is empty", path);
  if (decoded.text.find('\0') != std::string::npos) {
    return Fail("expected text, found a binary file (it holds a zero byte)", path);
  }
  if (const auto bad = FirstInvalidUtf8(decoded.text)) {
    const auto line = std::count(decoded.text.begin(), decoded.text.begin() + *bad, '\n') + 1;
    decoded.remark =
        fmt::format("the file is not UTF-8 (line {}): read as Windows-1252 (Latin-1)", line);
    decoded.text = FromWindows1252(decoded.text);
  }
  return decoded;
}

Expected<DecodedText> ReadDecodedFile(const std::string& path, std::uintmax_t largest_bytes) {
  TRY(std::string bytes, ReadFileBytes(path, largest_bytes));
  return DecodeText(std::move(bytes), path);
}

}  // namespace lyrefit
