#include "lyrefit/base/option.h"

#include <fmt/format.h>

#include <cmath>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/setting_text.h"

namespace lyrefit {

Expected<std::vector<std::string>> SplitList(const std::string& text) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
    end = text.find(',', begin);
    parts.push_back(text.substr(begin, end - begin));
    if (parts.back().empty()) {
      return Fail("expected a list such as a,b,c, found '" + text + "'");
    }
  }
  return parts;
}

std::string JoinList(const std::vector<std::string>& parts) {
  std::string list;
  for (const std::string& part : parts) list += (list.empty() ? "" : ",") + part;
  return list;
}

namespace {

tl::unexpected<Error> MisreadSetting(const char* example, const std::string& text) {
  return Fail(fmt::format("expected {}, found '{}'", example, text));
}

// Splits "a<separator>b"; nullopt unless the separator occurs exactly once.
std::optional<std::pair<std::string, std::string>> Sides(const std::string& text, char separator) {
  const std::size_t at = text.find(separator);
  if (at == std::string::npos || text.find(separator, at + 1) != std::string::npos) return {};
  return std::pair(text.substr(0, at), text.substr(at + 1));
}

// A number that is finite and no code of an overflow.
std::optional<double> NumberIn(const std::string& text) {
  const std::optional<double> value = ParseNumber(text);
  return value && std::fabs(*value) <= kOverflowCode ? value : std::nullopt;
}

}  // namespace

Expected<std::pair<std::string, double>> ReadAssignment(const std::string& text) {
  const auto sides = Sides(text, '=');
  const std::optional<double> value = sides ? NumberIn(sides->second) : std::nullopt;
  if (!value || sides->first.empty()) {
    return MisreadSetting("PARAMETER=VALUE such as n2=2", text);
  }
  return std::pair(sides->first, *value);
}

Expected<std::pair<std::string, std::pair<double, double>>> ReadRange(const std::string& text) {
  constexpr char kExample[] = "PARAMETER=LOWER:UPPER such as Rs=0:0.5";
  const auto sides = Sides(text, '=');
  if (!sides || sides->first.empty()) return MisreadSetting(kExample, text);
  const auto ends = Sides(sides->second, ':');
  if (!ends) return MisreadSetting(kExample, text);
  const std::optional<double> lower = NumberIn(ends->first);
  const std::optional<double> upper = NumberIn(ends->second);
  if (!lower || !upper) return MisreadSetting(kExample, text);
  return std::pair(sides->first, std::pair(*lower, *upper));
}

std::string AssignmentText(const std::string& name, double value) {
  return fmt::format("{}={:g}", name, value);
}

std::string RangeText(const std::string& name, const std::pair<double, double>& range) {
  return fmt::format("{}={:g}:{:g}", name, range.first, range.second);
}

}  // namespace lyrefit
