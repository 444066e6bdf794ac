#include "lyrefit/read/json_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"

namespace lyrefit {
namespace {

using nlohmann::json;

constexpr int kDeepest = 64;

struct Position {
  int line = 1;
  int column = 1;
};

Position PositionOf(const std::string& text, std::size_t offset) {
  offset = std::min(offset, text.size());
  Position position;
  std::size_t begin = 0;
  for (std::size_t at; (at = text.find('\n', begin)) < offset; begin = at + 1) ++position.line;
  position.column = static_cast<int>(offset - begin) + 1;
  return position;
}

// Parses without building a document. It locates syntax errors, and limits the depth so that nested
// brackets cannot exhaust the memory.
class Inspector : public nlohmann::json_sax<json> {
 public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool key(string_t&) override { return true; }
  bool start_object(std::size_t) override { return ++depth_ <= kDeepest; }
  bool end_object() override { return --depth_ >= 0; }
  bool start_array(std::size_t) override { return ++depth_ <= kDeepest; }
  bool end_array() override { return --depth_ >= 0; }
  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::detail::exception&) override {
    position_ = position;
    return false;
  }

  bool too_deep() const { return depth_ > kDeepest; }
  std::size_t position() const { return position_; }  // from 1, of the last byte read

 private:
  int depth_ = 0;
  std::size_t position_ = 0;
};

std::string Shown(const json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "a list";
  return Quoted(OneLine(value));
}

}  // namespace

std::string OneLine(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string Dump(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::optional<std::string> FirstDifference(const nlohmann::ordered_json& before,
                                           const nlohmann::ordered_json& now) {
  for (const auto& [key, value] : now.items()) {
    if (!before.contains(key) || before[key] != value) return key;
  }
  for (const auto& [key, value] : before.items()) {
    if (!now.contains(key)) return key;
  }
  return std::nullopt;
}

std::string MemberText(const nlohmann::ordered_json& object, const std::string& key) {
  const auto found = object.find(key);
  if (found == object.end() || found->is_null()) return "nothing";
  return found->is_string() ? found->get<std::string>() : found->dump();
}

Expected<json> ParseJson(const std::string& text, const std::string& file) {
  Inspector inspector;
  if (!json::sax_parse(text, &inspector)) {
    if (inspector.too_deep()) {
      return Fail(fmt::format("expected JSON of at most {} levels, found more", kDeepest), file);
    }
    const std::size_t position = inspector.position();
    const Position place = PositionOf(text, position == 0 ? 0 : position - 1);
    const bool ended = position > text.size();
    const std::string found =
        ended ? "the end of the file" : Quoted(std::string_view(text).substr(position - 1, 1));
    return Fail("expected valid JSON in UTF-8, found an error at " + found, file, place.line,
                place.column);
  }
  return json::parse(text, nullptr, false);
}

Expected<std::optional<json>> DocumentIn(const std::string& text, const std::string& path) {
  const std::string ending = LowerCase(std::filesystem::path(path).extension().string());
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  const bool may_be = first != std::string::npos && (text[first] == '{' || text[first] == '[');
  if (ending != ".json" && !may_be) return std::optional<json>();
  Expected<json> document = ParseJson(text, path);
  if (document && (document->is_structured() || ending == ".json")) {
    return std::optional<json>(std::move(*document));
  }
  if (ending == ".json") return tl::unexpected(document.error());
  return std::optional<json>();
}

const json* JsonFields::Find(std::initializer_list<const char*> keys, std::string* key) const {
  for (const char* candidate : keys) {
    const auto found = object_.find(candidate);
    if (found == object_.end() || found->is_null()) continue;
    *key = candidate;
    return &*found;
  }
  return nullptr;
}

Expected<std::optional<double>> JsonFields::Number(std::initializer_list<const char*> keys) const {
  std::string key;
  const json* value = Find(keys, &key);
  if (value == nullptr) return std::optional<double>();
  if (!value->is_number()) return Refuse(key, "a number");
  const double number = value->get<double>();
  if (!(std::fabs(number) < kOverflowCode)) return Refuse(key, "a number below 1e30");
  return std::optional<double>(number);
}

Expected<std::optional<int>> JsonFields::WholeNumber(
    std::initializer_list<const char*> keys) const {
  TRY(const auto number, Number(keys));
  if (!number) return std::optional<int>();
  std::string key;
  Find(keys, &key);
  if (*number != std::floor(*number)) return Refuse(key, "a whole number");
  if (std::abs(*number) > 1e6) return Refuse(key, "at most a million");
  return std::optional<int>(static_cast<int>(*number));
}

Expected<std::optional<std::string>> JsonFields::Text(const char* key) const {
  std::string name;
  const json* value = Find({key}, &name);
  if (value == nullptr) return std::optional<std::string>();
  if (!value->is_string()) return Refuse(key, "a text");
  return std::optional<std::string>(value->get<std::string>());
}

tl::unexpected<Error> JsonFields::Refuse(const std::string& key,
                                         const std::string& expected) const {
  const auto value = object_.find(key);
  const std::string found = value == object_.end() ? "nothing" : Shown(*value);
  std::string message = fmt::format("expected {} in \"{}\", found {}", expected, key, found);
  const std::size_t at = text_.find("\"" + key + "\"");
  if (at == std::string::npos) return Fail(std::move(message), file_);
  const Position place = PositionOf(text_, at);
  return Fail(std::move(message), file_, place.line, place.column);
}

std::optional<double> NumberOrText(const json& value) {
  std::optional<double> number;
  if (value.is_number()) number = value.get<double>();
  if (value.is_string()) number = ParseNumber(value.get_ref<const std::string&>());
  if (number && !std::isfinite(*number)) return std::nullopt;
  return number;
}

}  // namespace lyrefit
