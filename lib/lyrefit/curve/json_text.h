#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "lyrefit/base/error.h"

namespace lyrefit {

// Parses JSON of at most 64 levels; the error says line and column. `file` is only for the errors.
Expected<nlohmann::json> ParseJson(const std::string& text, const std::string& file);

// Looks up keys of one JSON object and remembers where they stand in the text, for the errors. A
// null value counts as not given.
class JsonFields {
 public:
  JsonFields(const nlohmann::json& object, const std::string& text, const std::string& file)
      : object_(object), text_(text), file_(file) {}

  // The value of the first of `keys` that is given, nullptr if none is; `key` receives its name.
  const nlohmann::json* Find(std::initializer_list<const char*> keys, std::string* key) const;

  // Empty where not given, an error where of another type.
  Expected<std::optional<double>> Number(std::initializer_list<const char*> keys) const;
  Expected<std::optional<int>> WholeNumber(std::initializer_list<const char*> keys) const;
  Expected<std::optional<std::string>> Text(const char* key) const;

  // The error for a given key: "<file>:<line>:<column>: expected <expected> in "<key>", found ..."
  tl::unexpected<Error> Refuse(const std::string& key, const std::string& expected) const;

 private:
  const nlohmann::json& object_;
  const std::string& text_;
  const std::string& file_;
};

// A value as messages quote it: in one line, what is not UTF-8 replaced.
std::string OneLine(const nlohmann::json& value);

// The text of a JSON file: indented by two, with an end of line. What is not UTF-8 in it, such as
// the name of a file, is replaced; a number that is not finite is null.
std::string Dump(const nlohmann::ordered_json& json);

// A JSON number, or a text that holds one, as ivcurves files do.
std::optional<double> NumberOrText(const nlohmann::json& value);

}  // namespace lyrefit
