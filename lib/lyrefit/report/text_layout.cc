#include "lyrefit/report/text_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lyrefit {
std::string Significant(double value, int digits) {
  if (std::isnan(value)) return "-";
  if (value == 0) return "0";
  std::string text = fmt::format("{:#.{}g}", value, digits);
  // fmt adds ".0" if all digits are before the point.
  const auto shown =
      std::count_if(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  const bool whole = text.size() > 2 && text.compare(text.size() - 2, 2, ".0") == 0;
  if (whole && shown > digits) text.resize(text.size() - 2);
  return text;
}

std::string Scientific(double value, int digits) {
  return std::isnan(value) ? "-" : fmt::format("{:.{}e}", value, digits - 1);
}

std::string Range(double low, double high) {
  if (std::isnan(low) || std::isnan(high)) return "-";
  const double largest = std::max(std::isfinite(low) ? std::abs(low) : 0.0,
                                  std::isfinite(high) ? std::abs(high) : 0.0);
  int digits = 4;
  if (std::isfinite(low) && std::isfinite(high) && high > low) {
    digits = std::clamp(2 + static_cast<int>(std::ceil(std::log10(largest / (high - low)))), 3, 8);
  }
  return Significant(low, digits) + " .. " + Significant(high, digits);
}

std::string Duration(double seconds) {
  if (std::isnan(seconds)) return "-";
  if (seconds < 1) return fmt::format("{:.3g} ms", seconds * 1e3);
  return fmt::format("{:.3g} s", seconds);
}

std::string Wrap(std::string_view first, std::string_view text) {
  const std::string indent(Columns(first), ' ');
  std::string wrapped(first);
  std::size_t column = indent.size();
  bool line_is_empty = true;
  while (!text.empty()) {
    const std::size_t begin = text.find_first_not_of(" \n\t\r");
    if (begin == std::string_view::npos) break;
    text.remove_prefix(begin);
    const std::string_view word = text.substr(0, text.find_first_of(" \n\t\r"));
    text.remove_prefix(word.size());
    const std::size_t width = Columns(word);
    if (!line_is_empty && column + 1 + width > kTextWidth) {
      wrapped += "\n" + indent;
      column = indent.size();
      line_is_empty = true;
    }
    if (!line_is_empty) wrapped += ' ';
    column += width + (line_is_empty ? 0 : 1);
    wrapped += word;
    line_is_empty = false;
  }
  return wrapped + "\n";
}

std::size_t Columns(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;  // continuation bytes take no column
  }));
}

}  // namespace lyrefit
