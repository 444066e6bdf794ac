#include "lyrefit/stream/json_elements.h"

#include <fmt/format.h>

#include <utility>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"

namespace lyrefit {
namespace {

constexpr std::size_t kElementBlock = 1U << 20;

bool IsJsonSpace(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

}  // namespace

JsonElements::JsonElements(const std::string& path, std::optional<std::string> key,
                           std::size_t longest)
    : file_(path), key_(std::move(key)), longest_(longest), block_(kElementBlock) {}

// Sets `c` to the next character without consuming it. False at the end of the file.
Expected<bool> JsonElements::Peek(char* c) {
  if (at_ == end_) {
    at_ = 0;
    TRY(end_, file_.Read(block_.data(), block_.size()));
    if (end_ == 0) return false;
  }
  *c = block_[at_];
  return true;
}

void JsonElements::Take() {
  if (block_[at_] == '\n') ++line_;
  ++at_;
  ++offset_;
}

// Appends the string at the current position, including its quotes, to `into`; null: discards it.
Expected<void> JsonElements::TakeString(std::string* into) {
  char c = 0;
  bool escaped = false;
  for (bool first = true;; first = false) {
    TRY(const bool more, Peek(&c));
    if (!more) return {};
    Take();
    if (into != nullptr && into->size() <= longest_) *into += c;
    if (!first && !escaped && c == '"') return {};
    escaped = !escaped && c == '\\';
  }
}

// Moves to the first item; false at the end of the document. Skipped text is added to `around_`.
Expected<bool> JsonElements::FindList() {
  int depth = 0;
  std::string last;
  char c = 0;
  for (;;) {
    TRY(const bool more, Peek(&c));
    if (!more || around_.size() > longest_) return false;
    if (c == '"') {
      last.clear();
      TRY(TakeString(&last));
      around_ += last;
      continue;
    }
    Take();
    around_ += c;
    const bool here = key_ ? depth == 1 && last == "\"" + *key_ + "\"" : depth == 0;
    if (c == '[' && here) {
      in_list_ = true;
      return true;
    }
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (c == ',' && depth == 1) last.clear();
  }
}

// Reads an item from its first character to its end.
Expected<void> JsonElements::TakeElement(JsonElement* element) {
  int depth = 0;
  char c = 0;
  bool cut = true;
  for (;;) {
    TRY(const bool more, Peek(&c));
    if (!more) break;
    if (depth == 0 && !element->text.empty() && (c == ',' || c == ']' || IsJsonSpace(c))) {
      cut = false;
      break;
    }
    const bool keep = element->text.size() <= longest_;
    if (c == '"') {
      TRY(TakeString(keep ? &element->text : nullptr));
      continue;
    }
    Take();
    if (keep) element->text += c;
    if (c == '[' || c == '{') ++depth;
    if ((c == ']' || c == '}') && --depth == 0) {
      cut = false;
      break;
    }
  }
  element->end = offset_;
  if (element->text.size() > longest_) {
    element->broken = fmt::format("the curve is longer than the limit of {} bytes", longest_);
  } else if (cut) {
    element->broken = "expected the end of the curve, found the end of the file: it is cut off";
  } else if (element->text.front() != '{') {
    element->broken =
        fmt::format("expected a curve that begins with '{{', found {}", Quoted(element->text));
  }
  return {};
}

Expected<std::optional<JsonElement>> JsonElements::Next() {
  using Found = std::optional<JsonElement>;
  if (over_) return Found();
  if (!in_list_) {
    TRY(const bool found, FindList());
    if (!found) return Found();
  }
  char c = 0;
  for (;;) {
    TRY(const bool more, Peek(&c));
    JsonElement element;
    element.begin = offset_;
    element.line = line_;
    if (!more) {
      over_ = true;
      element.end = offset_;
      element.broken = "expected ']', found the end of the file: the list of curves is cut off";
      return Found(std::move(element));
    }
    if (c == ']') {
      in_list_ = false;
      TRY(const bool again, FindList());  // reads the rest of the document
      over_ = !again;
      if (over_) return Found();
      continue;
    }
    if (IsJsonSpace(c) || c == ',') {
      Take();
      continue;
    }
    TRY(TakeElement(&element));
    return Found(std::move(element));
  }
}

}  // namespace lyrefit
