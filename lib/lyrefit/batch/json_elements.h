#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/batch/line_scanner.h"

namespace lyrefit {

// An item of the list of curves in a JSON document, or what stands in its place.
struct JsonElement {
  std::string text;  // of the whole element
  std::int64_t begin = 0;
  std::int64_t end = 0;
  std::int64_t line = 0;  // where it begins
  std::string broken;     // why it is none
};

// Takes the items of one list out of a JSON document one by one, without holding the document: the
// list that is the document, or that stands under a key of its outermost object. The rest of that
// object is kept. Looks at brackets and quotes alone; what an item is made of is for its reader.
class JsonElements {
 public:
  JsonElements(const std::string& path, std::optional<std::string> key, std::size_t longest);

  // Nothing at the end of the document. A document that ends in the middle has a broken element
  // last.
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
