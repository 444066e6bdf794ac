// Optimized fully: rows are parsed character by character.
#include "lyrefit/stream/row_curve.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"

namespace lyrefit {
namespace {

enum class Lists { kRead, kSkip };

bool IsRowSpace(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

bool EndsToken(char c) { return c == ',' || c == ']' || c == '}' || c == ':' || IsRowSpace(c); }

// The text with the read position.
struct Cursor {
  std::string_view text;
  std::size_t at = 0;
  Lists lists = Lists::kRead;

  bool over() const { return at >= text.size(); }
  char peek() const { return over() ? '\0' : text[at]; }
  int column() const { return static_cast<int>(at) + 1; }

  void SkipSpace() {
    while (!over() && IsRowSpace(text[at])) ++at;
  }
  bool Take(char c) {
    if (over() || text[at] != c) return false;
    ++at;
    return true;
  }
  // The text up to the delimiter of a number or a word.
  std::string_view Word() {
    const std::size_t begin = at;
    while (!over() && !EndsToken(text[at])) ++at;
    return text.substr(begin, at - begin);
  }
  tl::unexpected<Error> Refuse(const std::string& expected) const {
    const std::string found = over() ? "the end of the row" : Quoted(text.substr(at, 1));
    return Fail(fmt::format("expected {}, found {}", expected, found), "", 0, column());
  }
};

// Position after the closing quote of the string that begins at `at`; npos if there is none.
std::size_t EndOfString(std::string_view text, std::size_t at) {
  for (++at; at < text.size(); ++at) {
    at = text.find_first_of("\"\\", at);
    if (at == std::string_view::npos) return at;
    if (text[at] == '"') return at + 1;
    ++at;  // skips the escaped character
  }
  return std::string_view::npos;
}

Expected<std::string> TakeString(Cursor* cursor) {
  const std::size_t begin = cursor->at;
  const std::size_t end = EndOfString(cursor->text, begin);
  if (end == std::string_view::npos) {
    return Fail("expected a closing quote, found the end of the row", "", 0, cursor->column());
  }
  cursor->at = end;
  const std::string_view inside = cursor->text.substr(begin + 1, end - begin - 2);
  bool plain = true;
  for (const char c : inside) {
    const auto byte = static_cast<unsigned char>(c);
    plain = plain && byte >= 0x20 && byte < 0x80 && c != '\\';
  }
  if (plain) return std::string(inside);
  const auto decoded =
      nlohmann::json::parse(cursor->text.substr(begin, end - begin), nullptr, false);
  if (!decoded.is_string()) {
    return Fail("expected a text in UTF-8 with valid escapes, found another", "", 0,
                static_cast<int>(begin) + 1);
  }
  return decoded.get<std::string>();
}

// Position after a list of plain numbers or words that begins at `at`; npos for anything else. This
// is the fast path, since most of a file consists of such lists.
std::size_t EndOfPlainList(std::string_view text, std::size_t at) {
  const std::size_t end = text.find(']', at);
  if (end == std::string_view::npos) return end;
  const std::string_view inside = text.substr(at + 1, end - at - 1);
  for (const char c : {'"', '[', '{'}) {
    if (inside.find(c) != std::string_view::npos) return std::string_view::npos;
  }
  return end + 1;
}

bool IsJsonWord(std::string_view word) {
  if (word == "null" || word == "true" || word == "false") return true;
  if (word == "NaN" || word == "Infinity" || word == "-Infinity") return true;
  const bool digits = !word.empty() && (word[0] == '-' || (word[0] >= '0' && word[0] <= '9'));
  return digits && ParseNumber(word).has_value();
}

bool IsPlainNumber(std::string_view word) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error != std::errc::invalid_argument && end == word.data() + word.size();
}

Expected<void> TakeListItem(Cursor* cursor, Record* list) {
  const int column = cursor->column();
  if (cursor->peek() == '"') {
    TRY(const std::string text, TakeString(cursor));
    AddReading(text, false, column, list);
    return {};
  }
  const std::string_view word = cursor->Word();
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool number = error == std::errc() && end == word.data() + word.size();
  if (number && std::fabs(value) < kOverflowCode) {
    list->values.push_back(value);
    return {};
  }
  if (word.empty()) return cursor->Refuse("a number");
  const bool too_large = error == std::errc::result_out_of_range;
  if (!number && !too_large && !IsJsonWord(word)) {
    return Fail(fmt::format("expected a number in \"{}\"[{}], found {}", list->name,
                            list->values.size(), Quoted(word)),
                "", 0, column);
  }
  AddReading(word, false, column, list);
  return {};
}

// Reads a list of scalars. False if it holds other values; the cursor then stays at the beginning
// of the list.
Expected<bool> TakeList(Cursor* cursor, std::string name, Records* fields) {
  const std::size_t begin = cursor->at;
  Record list;
  list.name = std::move(name);
  list.column = cursor->column();
  cursor->Take('[');
  cursor->SkipSpace();
  if (!cursor->Take(']')) {
    for (;;) {
      cursor->SkipSpace();
      if (cursor->peek() == '[' || cursor->peek() == '{') {
        cursor->at = begin;
        return false;
      }
      TRY(TakeListItem(cursor, &list));
      cursor->SkipSpace();
      if (cursor->Take(']')) break;
      if (!cursor->Take(',')) return cursor->Refuse("',' or ']'");
    }
  }
  fields->lists.push_back(std::move(list));
  return true;
}

Expected<void> TakeAssumptions(Cursor* cursor, Records* fields) {
  const std::size_t begin = cursor->at;
  const std::size_t end = SkipJsonValue(cursor->text, begin);
  const auto list = nlohmann::json::parse(cursor->text.substr(begin, end - begin), nullptr, false);
  if (list.is_discarded()) return cursor->Refuse("a list of texts");
  cursor->at = end;
  for (const auto& item : list) {
    if (item.is_string()) fields->assumptions.push_back(item.get<std::string>());
  }
  return {};
}

Expected<void> TakeNested(Cursor* cursor, Records* fields) {
  const std::size_t end = SkipJsonValue(cursor->text, cursor->at);
  const char close = cursor->peek() == '[' ? ']' : '}';
  if (cursor->text[end - 1] != close) {
    cursor->at = cursor->text.size();
    return cursor->Refuse(fmt::format("'{}'", close));
  }
  cursor->at = end;
  fields->nested = true;
  return {};
}

Expected<void> TakeValue(Cursor* cursor, std::string name, Records* fields) {
  const int column = cursor->column();
  const char first = cursor->peek();
  if (first == '"') {
    TRY(std::string text, TakeString(cursor));
    fields->scalars.push_back({std::move(name), std::move(text), true, column});
    return {};
  }
  if (first == '[' && name == "assumptions") return TakeAssumptions(cursor, fields);
  if (first == '[' && cursor->lists == Lists::kRead) {
    TRY(const bool taken, TakeList(cursor, std::move(name), fields));
    return taken ? Expected<void>() : TakeNested(cursor, fields);
  }
  if (first == '[' || first == '{') return TakeNested(cursor, fields);
  const std::string_view word = cursor->Word();
  if (word == "null") return {};
  if (!IsJsonWord(word) && !IsPlainNumber(word)) {
    if (word.empty()) return cursor->Refuse("a value");
    return Fail(fmt::format("expected a value of \"{}\", found {}", name, Quoted(word)), "", 0,
                column);
  }
  const bool is_text = word == "true" || word == "false";
  fields->scalars.push_back({std::move(name), std::string(word), is_text, column});
  return {};
}

Expected<void> TakeObject(Cursor* cursor, Records* fields) {
  cursor->SkipSpace();
  if (!cursor->Take('{')) return cursor->Refuse("a JSON object that begins with '{'");
  cursor->SkipSpace();
  if (cursor->Take('}')) return {};
  for (;;) {
    cursor->SkipSpace();
    if (cursor->peek() != '"') return cursor->Refuse("a name in quotes");
    TRY(std::string name, TakeString(cursor));
    cursor->SkipSpace();
    if (!cursor->Take(':')) return cursor->Refuse("':'");
    cursor->SkipSpace();
    TRY(TakeValue(cursor, std::move(name), fields));
    cursor->SkipSpace();
    if (cursor->Take('}')) return {};
    if (!cursor->Take(',')) return cursor->Refuse("',' or '}'");
  }
}

}  // namespace

std::size_t SkipJsonValue(std::string_view text, std::size_t at) {
  if (at < text.size() && text[at] == '[') {
    if (const std::size_t end = EndOfPlainList(text, at); end != std::string_view::npos) return end;
  }
  int depth = 0;
  while (at < text.size()) {
    const char c = text[at];
    if (c == '"') {
      at = EndOfString(text, at);
      if (at == std::string_view::npos) return text.size();
      if (depth == 0) return at;
      continue;
    }
    if (depth == 0 && c != '[' && c != '{') {
      while (at < text.size() && !EndsToken(text[at])) ++at;
      return at;
    }
    if (c == '[' || c == '{') ++depth;
    if ((c == ']' || c == '}') && --depth == 0) return at + 1;
    ++at;
  }
  return at;
}

Expected<void> ParseJsonRow(std::string_view text, Records* fields) {
  if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos) {
    return Fail("expected text, found a zero byte", "", 0, static_cast<int>(zero) + 1);
  }
  Cursor cursor{text};
  TRY(TakeObject(&cursor, fields));
  cursor.SkipSpace();
  if (!cursor.over()) return cursor.Refuse("the end of the row");
  return {};
}

void ScanJsonScalars(std::string_view text, Records* fields) {
  Cursor cursor{text, 0, Lists::kSkip};
  (void)TakeObject(&cursor, fields);  // the values before a syntax error are kept
}

}  // namespace lyrefit
