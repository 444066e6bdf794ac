#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "lyrefit/base/error.h"

namespace lyrefit {

// Parses JSON of at most 64 levels. The error names line and column. `file` is only used in errors.
Expected<nlohmann::json> ParseJson(const std::string& text, const std::string& file);

// The JSON object or list that a text holds, whatever its file is called; nullopt if it holds
// another text. Error: invalid JSON in a file named .json.
Expected<std::optional<nlohmann::json>> DocumentIn(const std::string& text,
                                                   const std::string& path);

// What `read` returns. Where it asks a value of JSON for another type, an error that names the file.
template <class Read>
auto WithoutTypeErrors(const std::string& file, const Read& read) -> decltype(read()) {
  try {
    return read();
  } catch (const nlohmann::json::exception& error) {
    const std::string text = error.what();  // [json.exception.type_error.302] type must be ...
    return Fail("a value is of another type than expected:" + text.substr(text.find(']') + 1),
                file);
  }
}

// Looks up keys of one JSON object and their positions in the text, for errors. A null value counts
// as missing.
class JsonFields {
 public:
  JsonFields(const nlohmann::json& object, const std::string& text, const std::string& file)
      : object_(object), text_(text), file_(file) {}

  // The value of the first key of `keys` that is present, nullptr if none is. `key` receives its
  // name.
  const nlohmann::json* Find(std::initializer_list<const char*> keys, std::string* key) const;

  // Value of a key; nullopt if missing, an error if of another type or as large as an overflow code.
  Expected<std::optional<double>> Number(std::initializer_list<const char*> keys) const;
  Expected<std::optional<int>> WholeNumber(std::initializer_list<const char*> keys) const;
  Expected<std::optional<std::string>> Text(const char* key) const;

  // Error for a key that is present: "<file>:<line>:<column>: expected <expected> in "<key>", found
  // ..."
  tl::unexpected<Error> Refuse(const std::string& key, const std::string& expected) const;

 private:
  const nlohmann::json& object_;
  const std::string& text_;
  const std::string& file_;
};

// A value as one line of text for messages; invalid UTF-8 is replaced.
std::string OneLine(const nlohmann::json& value);

// Formats JSON for a file, with an indent of two and a final line end. Invalid UTF-8, for example
// in a file name, is replaced. Numbers that are not finite become null.
std::string Dump(const nlohmann::ordered_json& json);

// The first member by which two objects differ, in the order of `now`, then of `before`. nullopt if
// they are equal.
std::optional<std::string> FirstDifference(const nlohmann::ordered_json& before,
                                           const nlohmann::ordered_json& now);

// The value of a member for messages: a text without quotation marks, "nothing" if it is missing.
std::string MemberText(const nlohmann::ordered_json& object, const std::string& key);

// A JSON number, or a text that holds one, as in ivcurves files. nullopt if not finite.
std::optional<double> NumberOrText(const nlohmann::json& value);

// The sheet of a module in JSON, and its text for the places of errors.
struct ModuleJson {  // NOLINT(bugprone-exception-escape): nlohmann's destructor
  std::string text;
  nlohmann::json json;
};

// Reads a sheet. Errors: no JSON object, a key that no sheet has; the message lists all that are
// known.
Expected<ModuleJson> ReadModuleJson(const std::string& file);

}  // namespace lyrefit
