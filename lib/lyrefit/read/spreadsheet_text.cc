#include "lyrefit/read/spreadsheet_text.h"

#include <algorithm>
#include <iterator>

#include "lyrefit/base/number_text.h"

namespace lyrefit {
namespace {

// Whether the text is a number of digits, signs, point and exponent.
bool IsPlainNumber(std::string_view text) {
  return text.find_first_not_of("+-.0123456789eE") == std::string_view::npos &&
         ParseNumber(text).has_value();
}

}  // namespace

bool RunsInSpreadsheets(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  constexpr std::string_view kSigns[] = {
      "=", "+", "-", "@", "\xef\xbc\x9d", "\xef\xbc\x8b", "\xef\xbc\x8d", "\xef\xbc\xa0"};
  text.remove_prefix(std::min(text.find_first_not_of('\''), text.size()));
  if (text.empty()) return false;
  const bool breaks = text.front() == '\t' || text.front() == '\r' || text.front() == '\n';
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  if (breaks || text.empty()) return breaks;
  text = text.substr(0, text.find_last_not_of(kBlanks) + 1);
  return std::any_of(std::begin(kSigns), std::end(kSigns), [text](std::string_view sign) {
    return text.size() > sign.size() && text.substr(0, sign.size()) == sign && !IsPlainNumber(text);
  });
}

std::string WithoutApostrophe(std::string text) {
  if (!text.empty() && text.front() == '\'' && RunsInSpreadsheets(text)) text.erase(0, 1);
  return text;
}

}  // namespace lyrefit
