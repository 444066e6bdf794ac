#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/stream/line_scanner.h"

namespace lyrefit {

// An item of the list of curves in a JSON document, or an error in its place.
struct JsonElement {
  std::string text;  // complete text of the item
  std::int64_t begin = 0;
  std::int64_t end = 0;
  std::int64_t line = 0;  // its first line
  std::string broken;     // reason why it is not an item; empty: it is
};

// Reads the items of one list in a JSON document one by one, without holding the document. The list
// is the document itself, or the value of a key of its outermost object. The rest of that object is
// kept. Only brackets and quotes are parsed here; the reader of an item parses its content.
class JsonElements {
 public:
  JsonElements(const std::string& path, std::optional<std::string> key, std::size_t longest);

  // The next item; empty at the end of the document. If the document is truncated, the last item is
  // broken.
  Expected<std::optional<JsonElement>> Next();

  // The document without the list, as far as it was read.
  const std::string& around() const { return around_; }

 private:
  Expected<bool> Peek(char* c);
  void Take();
  Expected<bool> FindList();
  Expected<void> TakeString(std::string* into);
  Expected<void> TakeElement(JsonElement* element);

  ByteInput file_;
  std::optional<std::string> key_;
  std::size_t longest_;
  std::vector<char> block_;
  std::size_t at_ = 0;
  std::size_t end_ = 0;
  std::int64_t offset_ = 0;
  std::int64_t line_ = 1;
  std::string around_;
  bool in_list_ = false;
  bool over_ = false;
};

}  // namespace lyrefit
