// Optimized fully: rows are parsed character by character.
#include "lyrefit/stream/list_text.h"

#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include "lyrefit/base/number_text.h"

namespace lyrefit {
namespace {

constexpr std::string_view kBrackets = "[](){}";
constexpr std::string_view kBlanks = " \t";

std::string_view Inside(std::string_view text) {
  text = TrimBlanks(text);
  while (!text.empty() && kBrackets.find(text.front()) != std::string_view::npos) {
    text.remove_prefix(1);
  }
  while (!text.empty() && kBrackets.find(text.back()) != std::string_view::npos) {
    text.remove_suffix(1);
  }
  return TrimBlanks(text);
}

// The separator of a list. Blanks separate only if there is no other separator; otherwise they
// belong to the other separator.
char SeparatorOf(std::string_view text) {
  for (const char c : {';', '|'}) {
    if (text.find(c) != std::string_view::npos) return c;
  }
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return ' ';
  // "8,49 8,48": the commas are decimal commas if every blank is between digits.
  const std::size_t blank = text.find_first_of(kBlanks);
  if (blank == std::string_view::npos) return ',';
  for (std::size_t at = blank; at != std::string_view::npos; at = text.find_first_of(kBlanks, at)) {
    if (at > 0 && text[at - 1] == ',') return ',';
    at = text.find_first_not_of(kBlanks, at);
    if (at == std::string_view::npos) break;
    if (text[at] == ',') return ',';
  }
  return ' ';
}

// Calls take(item) for each item. Items may be empty, except between blanks.
template <class Take>
void ForEachItem(std::string_view text, char separator, Take take) {
  if (text.empty()) return;
  std::size_t at = 0;
  while (at <= text.size()) {
    if (separator == ' ') {
      at = std::min(text.find_first_not_of(kBlanks, at), text.size());
      if (at == text.size()) return;
    }
    const std::size_t stop =
        separator == ' ' ? text.find_first_of(kBlanks, at) : text.find(separator, at);
    const std::size_t end = std::min(stop, text.size());
    take(TrimBlanks(text.substr(at, end - at)));
    at = end + 1;
  }
}

}  // namespace

void ParseList(std::string_view text, int column, Record* list) {
  text = Inside(text);
  const char separator = SeparatorOf(text);
  if (separator != ' ' && !text.empty() && text.back() == separator) text.remove_suffix(1);
  ForEachItem(text, separator, [&](std::string_view item) {
    double value = 0;
    const auto [end, error] = std::from_chars(item.data(), item.data() + item.size(), value);
    const bool plain = error == std::errc() && end == item.data() + item.size();
    if (plain && std::fabs(value) < kOverflowCode) {
      list->values.push_back(value);
    } else {
      AddReading(item, separator != ',', column, list);
    }
  });
}

bool IsList(std::string_view text) {
  text = Inside(text);
  constexpr std::size_t kLook = 200;
  text = text.substr(0, kLook);
  const char separator = SeparatorOf(text);
  int numbers = 0;
  int others = 0;
  ForEachItem(text, separator, [&](std::string_view item) {
    ++(ParseNumber(item, separator != ',') ? numbers : others);
  });
  return numbers >= 2 && numbers > others;
}

bool ParsePairs(std::string_view text, int column, Records* fields) {
  text = Inside(text);
  const bool stars = text.find('*') != std::string_view::npos;
  const char between = stars ? '*' : ':';
  const char separator = text.find('#') != std::string_view::npos ? '#' : SeparatorOf(text);
  Record first;
  Record second;
  first.name = "V";
  second.name = "I";
  first.column = second.column = column;
  bool pairs = true;
  std::size_t count = 0;
  ForEachItem(text, separator, [&](std::string_view item) {
    if (item.empty()) return;
    const std::size_t at = item.find(between);
    if (at == std::string_view::npos) {
      pairs = false;
      return;
    }
    const std::string_view left = TrimBlanks(item.substr(0, at));
    const std::string_view right = TrimBlanks(item.substr(at + 1));
    if (count++ == 0 && !ParseNumber(left) && !ParseNumber(right)) {
      if (LowerCase(left) == "i") std::swap(first.name, second.name);
      return;
    }
    AddReading(left, separator != ',', column, &first);
    AddReading(right, separator != ',', column, &second);
  });
  if (!pairs || first.values.empty()) return false;
  fields->lists.push_back(std::move(first));
  fields->lists.push_back(std::move(second));
  return true;
}

}  // namespace lyrefit
