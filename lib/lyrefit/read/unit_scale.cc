#include "lyrefit/read/unit_scale.h"

#include <algorithm>
#include <iterator>
#include <optional>

#include "lyrefit/base/number_text.h"

namespace lyrefit {
namespace {

bool IsLetter(char c) { return c >= 'a' && c <= 'z'; }
bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// A number from `at` on, with a point or a comma, and where it ends.
struct NumberAt {
  double value = 0;
  std::size_t end = 0;
};

std::optional<NumberAt> ReadNumberAt(std::string_view text, std::size_t at) {
  const std::size_t end = std::min(text.find_first_not_of("0123456789.,", at), text.size());
  const auto number = ParseNumber(text.substr(at, end - at), true);
  if (!number) return std::nullopt;
  return NumberAt{*number, end};
}

std::optional<double> AsScale(double number) {
  for (const double scale : {0.1, 0.01, 0.001}) {
    if (number == scale || number * scale == 1) return scale;
  }
  return std::nullopt;
}

ScaledLabel Without(std::string_view label, std::size_t begin, std::size_t end, double scale) {
  return {std::string(label.substr(0, begin)) + std::string(label.substr(end)), scale};
}

// "gain 10", "scale: 0.1", "factor=0.01". A gain is what the register multiplies by.
std::optional<ScaledLabel> ByWord(std::string_view label, std::string_view lower) {
  for (const std::string_view word : {"gain", "scale", "factor", "multiplier", "resolution"}) {
    const std::size_t at = lower.find(word);
    if (at == std::string_view::npos || (at > 0 && IsLetter(lower[at - 1]))) continue;
    const std::size_t digit = lower.find_first_not_of(" =:_", at + word.size());
    if (digit == std::string_view::npos || !IsDigit(lower[digit])) continue;
    const auto number = ReadNumberAt(lower, digit);
    const auto scale = number ? AsScale(number->value) : std::nullopt;
    const bool fits = scale && (word == "gain" || number->value < 1);
    if (fits) return Without(label, at, number->end, *scale);
  }
  return std::nullopt;
}

// "0.1V", "x0.01 A": a power of ten right before a volt or an ampere.
std::optional<ScaledLabel> BeforeUnit(std::string_view label, std::string_view lower) {
  for (std::size_t at = lower.find('0'); at != std::string_view::npos;
       at = lower.find('0', at + 1)) {
    std::size_t begin = at;
    if (begin > 0 && (lower[begin - 1] == 'x' || lower[begin - 1] == '*')) --begin;
    const char before = begin == 0 ? ' ' : lower[begin - 1];
    if (IsLetter(before) || IsDigit(before) || before == '.' || before == ',') continue;
    const auto number = ReadNumberAt(lower, at);
    if (!number || !(number->value < 1)) continue;
    const auto scale = AsScale(number->value);
    const std::size_t unit = lower.find_first_not_of(' ', number->end);
    if (!scale || unit == std::string_view::npos) continue;
    const bool known = lower[unit] == 'v' || lower[unit] == 'a';
    const char after = unit + 1 < lower.size() ? lower[unit + 1] : ' ';
    if (!known || IsLetter(after) || IsDigit(after) || after == '/') continue;
    return Without(label, begin, unit, *scale);
  }
  return std::nullopt;
}

}  // namespace

ScaledLabel TakeScale(std::string_view label) {
  constexpr std::size_t kLongest = 300;
  if (label.size() > kLongest || label.find_first_of("01") == std::string_view::npos) {
    return {std::string(label)};
  }
  const std::string lower = LowerCase(label);
  if (const auto scaled = ByWord(label, lower)) return *scaled;
  if (const auto scaled = BeforeUnit(label, lower)) return *scaled;
  return {std::string(label)};
}

}  // namespace lyrefit
