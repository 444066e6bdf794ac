#include "lyrefit/base/number_text.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <system_error>
#include <utility>

namespace lyrefit {
namespace {

#if defined(__cpp_lib_to_chars)
std::optional<double> ConvertPlain(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}
#else  // std::from_chars reads integers only: strtod, restricted to the same syntax
std::optional<double> ConvertPlain(std::string_view text) {
  const bool beyond = text.empty() || text.find_first_of("xX") != std::string_view::npos ||
                      std::isspace(static_cast<unsigned char>(text[0])) != 0 || text[0] == '+';
  if (beyond) return std::nullopt;
  const std::string copy(text);
  char* end = nullptr;
  errno = 0;
  const double value = std::strtod(copy.c_str(), &end);
  const bool out_of_range = errno == ERANGE && (value == 0 || std::isinf(value));
  if (out_of_range || end != copy.c_str() + copy.size()) return std::nullopt;
  return value;
}
#endif

std::optional<double> Convert(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  return ConvertPlain(text);
}

// Removes the blanks and apostrophes between thousands: "8 892,6", "8'892.6". A plain blank may also
// lie between two numbers, so it is one only in front of a decimal part. Returns other text unchanged.
std::string WithoutSpacedThousands(const std::string& text) {
  std::string plain;
  std::size_t digits = 0;  // since the last mark
  bool marked = false, blank = false;
  std::size_t at = text[0] == '+' || text[0] == '-' ? 1 : 0;
  plain.append(text, 0, at);
  while (at < text.size()) {
    const char c = text[at];
    if (c >= '0' && c <= '9') {
      plain += text[at++];
      ++digits;
      continue;
    }
    std::size_t length = 0;
    for (const std::string_view mark : {" ", "'", "\u00a0", "\u2009", "\u202f", "\u2019"}) {
      if (text.compare(at, mark.size(), mark) == 0) length = mark.size();
    }
    if (length == 0) break;
    if (digits == 0 || digits > 3 || (marked && digits != 3)) return text;
    blank = blank || c == ' ';
    marked = true;
    digits = 0;
    at += length;
  }
  const bool decimal = at < text.size() && (text[at] == '.' || text[at] == ',');
  if (!marked || digits != 3 || (blank && !decimal)) return text;
  return plain + text.substr(at);
}

// Removes the separators of thousands from "8,892.6"; returns other text unchanged.
std::string WithoutThousands(std::string text, bool decimal_comma) {
  const std::size_t point = text.find_last_of(".,");
  if (point == std::string::npos || point == 0) return text;
  const char group = text[point] == '.' ? ',' : '.';
  if (group == '.' && !decimal_comma) return text;
  const std::size_t first = text.find(group);
  if (first == std::string::npos || first > point) return text;
  const std::size_t begin = text[0] == '+' || text[0] == '-' ? 1 : 0;
  if (first == begin || first - begin > 3) return text;
  std::string plain = text.substr(0, first);
  std::size_t at = first;
  for (; at < point; at += 4) {
    const std::string digits = text.substr(at + 1, 3);
    const bool whole = text[at] == group && at + 4 <= point &&
                       digits.find_first_not_of("0123456789") == std::string::npos;
    if (!whole) return text;
    plain += digits;
  }
  return plain + text.substr(point);
}

// Number of bytes that follow `lead` in a UTF-8 sequence; -1 if `lead` is invalid.
int Followers(unsigned char lead) {
  if (lead < 0x80) return 0;
  if (lead >= 0xc2 && lead <= 0xdf) return 1;
  if (lead >= 0xe0 && lead <= 0xef) return 2;
  if (lead >= 0xf0 && lead <= 0xf4) return 3;
  return -1;
}

// Overlong forms, surrogates and values above U+10FFFF are detected in the first following byte.
bool FirstFollowerFits(unsigned char lead, unsigned char next) {
  switch (lead) {
    case 0xe0:
      return next >= 0xa0;
    case 0xed:
      return next < 0xa0;
    case 0xf0:
      return next >= 0x90;
    case 0xf4:
      return next < 0x90;
    default:
      return true;
  }
}

}  // namespace

std::optional<double> ParseNumber(std::string_view text, bool decimal_comma) {
  if (const auto value = Convert(text)) return value;
  std::string plain(TrimBlanks(text));
  const std::string_view minus = "\u2212";
  for (std::size_t at; (at = plain.find(minus)) != std::string::npos;) {
    plain.replace(at, minus.size(), "-");
  }
  if (!plain.empty()) plain = WithoutSpacedThousands(plain);
  plain = WithoutThousands(std::move(plain), decimal_comma);
  if (decimal_comma && plain.find('.') == std::string::npos) {
    if (const std::size_t at = plain.find(','); at != std::string::npos) plain[at] = '.';
  }
  return Convert(plain);
}

bool IsMissingWord(std::string_view text) {
  static constexpr std::string_view kWords[] = {"na",       "n/a",    "#n/a", "null", "none",
                                                "overflow", "ovrflw", "ovf",  "err",  "error"};
  const std::string lower = LowerCase(text);
  return std::find(std::begin(kWords), std::end(kWords), lower) != std::end(kWords);
}

double HalfUnit(const std::string& printed) {
  const std::size_t exponent_at = printed.find_first_of("eE");
  const std::string mantissa = printed.substr(0, exponent_at);
  const double exponent = exponent_at == std::string::npos
                              ? 0
                              : ParseNumber(printed.substr(exponent_at + 1)).value_or(0);
  const std::size_t point = mantissa.find('.');
  const double decimals =
      point == std::string::npos ? 0 : static_cast<double>(mantissa.size() - point - 1);
  return 0.5 * std::pow(10.0, exponent - decimals);
}

bool IsMissingReading(std::string_view text, bool decimal_comma) {
  if (TrimBlanks(text).empty() || IsMissingWord(TrimBlanks(text))) return true;
  const std::optional<double> number = ParseNumber(text, decimal_comma);
  return number && !(std::fabs(*number) < kOverflowCode);
}

std::string_view TrimBlanks(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

std::string LowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

std::string DecimalPointHint(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos || ParseNumber(text) || !ParseNumber(text, true)) return "";
  std::string pointed(text);
  pointed[comma] = '.';
  return " (numbers have a decimal point: " + pointed + ")";
}

std::string Plural(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string Quoted(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string shown(text.substr(0, kLongest));
  // Does not cut a character in two.
  while (!shown.empty() && FirstInvalidUtf8(shown)) shown.pop_back();
  for (char& c : shown) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return "'" + shown + (shown.size() < text.size() ? "...'" : "'");
}

std::optional<std::size_t> FirstInvalidUtf8(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size()) {
    std::uint64_t eight;
    if (at + sizeof eight <= text.size()) {
      std::memcpy(&eight, text.data() + at, sizeof eight);
      if ((eight & 0x8080808080808080ULL) == 0) {
        at += sizeof eight;
        continue;
      }
    }
    const auto lead = static_cast<unsigned char>(text[at]);
    const int followers = Followers(lead);
    if (followers < 0 || at + followers >= text.size()) return at;
    for (int i = 1; i <= followers; ++i) {
      const auto next = static_cast<unsigned char>(text[at + i]);
      if ((next & 0xc0) != 0x80) return at;
      if (i == 1 && !FirstFollowerFits(lead, next)) return at;
    }
    at += followers + 1;
  }
  return std::nullopt;
}

}  // namespace lyrefit
