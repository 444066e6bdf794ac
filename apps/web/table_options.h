#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/base/option.h"
#include "lyrefit/simulate/text_readers.h"

// Option tables as a form: its description, and the reading of its texts.
namespace lyrefit {

// Content of a form: texts by option name; several texts for options that may be given repeatedly.
using FormTexts = std::map<std::string, std::vector<std::string>>;

// Whether a form has this option: those of the command, except the number of threads and the
// instruction set, of which a browser has only one.
template <class Options>
bool IsInForm(const OptionRow<Options>& row) {
  const std::string name = row.name;
  return !row.IsHeading() && !row.Is(OptionTrait::kNoFlag) && name != "threads" &&
         name != "kernel" && !std::holds_alternative<OptionNest<Options>>(row.field);
}

// The name in a form. An option that is true by default has a switch for false.
template <class Options>
std::string FormName(const OptionRow<Options>& row, const Options& defaults) {
  const auto* const member = std::get_if<bool Options::*>(&row.field);
  const bool off = member != nullptr && defaults.*(*member);
  return std::string(off ? "no-" : "") + row.name;
}

// Allowed texts, if the option has a list of them.
template <class Options>
std::vector<std::string> ChoicesOf(const OptionRow<Options>& row) {
  std::vector<std::string> choices;
  const auto* const text = std::get_if<OptionText<Options>>(&row.field);
  if (text == nullptr || text->allowed == nullptr) return choices;
  std::istringstream list(text->allowed());
  for (std::string choice; std::getline(list >> std::ws, choice, ',');) choices.push_back(choice);
  return choices;
}

// Appends {"group", "name", "unit", "doc", "kind", "choices", "default", "lower", "upper"} for
// every row. "kind": switch, number, text, or list (one line per text). `group` is the heading of
// rows before the first heading.
template <class Options, class Table>
void DescribeTable(const Table& table, const Options& defaults, nlohmann::ordered_json* rows,
                   std::string group = "") {
  for (const OptionRow<Options>& row : table) {
    if (row.IsHeading()) group = row.name;
    if (!IsInForm(row)) continue;
    const bool on_off = std::holds_alternative<bool Options::*>(row.field) ||
                        std::holds_alternative<OptionSwitch<Options>>(row.field);
    const bool number =
        std::visit([](auto field) { return IsNumberField<decltype(field)>::value; }, row.field);
    const std::vector<std::string> usual = OptionTexts(row, defaults);
    nlohmann::ordered_json entry = {
        {"group", group}, {"name", FormName(row, defaults)}, {"unit", row.unit}};
    entry["doc"] = row.doc;
    entry["kind"] = on_off ? "switch" : IsList(row) ? "list" : number ? "number" : "text";
    entry["choices"] = ChoicesOf(row);
    if (!on_off && !IsList(row) && !usual.empty()) entry["default"] = usual.front();
    if (number && row.lower > -kOverflowCode) entry["lower"] = row.lower;
    if (number && row.upper < 1e12) entry["upper"] = row.upper;
    rows->push_back(std::move(entry));
  }
}

template <class T>
Expected<void> ReadNumber(const std::string& text, T* value) {
  const std::optional<double> number = ParseNumber(text);
  if (!number) return Fail("expected a number, found '" + text + "'");
  if constexpr (std::is_integral_v<T>) {
    constexpr double kMost = 9007199254740992;  // 2^53: larger integers are not exact
    if (*number != std::floor(*number) || std::fabs(*number) > kMost ||
        (std::is_unsigned_v<T> && *number < 0) ||
        (sizeof(T) == sizeof(int) && std::fabs(*number) > 2e9)) {
      return Fail("expected a whole number, found '" + text + "'");
    }
  }
  *value = static_cast<T>(*number);
  return {};
}

// Sets a row's field from one text; `defaults` are those of the form.
template <class Options>
Expected<void> ReadField(const OptionRow<Options>& row, const std::string& text,
                         const Options& defaults, Options* options) {
  return std::visit(
      [&](const auto& field) -> Expected<void> {
        using Field = std::decay_t<decltype(field)>;
        if constexpr (std::is_same_v<Field, OptionText<Options>>) {
          if (field.read == nullptr) return Fail("can be set in code alone");
          return field.read(text, options, AllTextReaders());
        } else if constexpr (std::is_same_v<Field, OptionSwitch<Options>>) {
          field.set(options, text == "yes");
          return {};
        } else if constexpr (std::is_same_v<Field, bool Options::*>) {
          options->*field = (text == "yes") != (defaults.*field);
          return {};
        } else if constexpr (std::is_same_v<Field, std::string Options::*>) {
          options->*field = text;
          return {};
        } else if constexpr (std::is_same_v<Field, std::vector<std::string> Options::*>) {
          (options->*field).push_back(text);
          return {};
        } else if constexpr (IsNumberField<Field>::value) {
          return ReadNumber(text, &(options->*field));
        } else if constexpr (std::is_member_pointer_v<Field>) {  // optional numbers
          typename std::decay_t<decltype(options->*field)>::value_type value = {};
          Expected<void> read = ReadNumber(text, &value);
          if (read) options->*field = value;
          return read;
        } else {
          return Fail("is no option");
        }
      },
      row.field);
}

// Sets the options of a table that `form` has and removes them from it: any rest is unknown. Empty
// fields are ignored.
template <class Options, class Table>
Expected<void> ReadForm(const Table& table, FormTexts* form, Options* options) {
  const Options defaults = *options;
  for (const OptionRow<Options>& row : table) {
    const std::string name = row.IsHeading() ? "" : FormName(row, defaults);
    const auto found = form->find(name);
    if (found == form->end() || !IsInForm(row)) continue;
    for (const std::string& text : found->second) {
      Expected<void> read = ReadField(row, text, defaults, options);
      if (!read) {
        read.error().message = fmt::format("{}: {}", name, read.error().message);
        return read;
      }
    }
    form->erase(found);
  }
  return ValidateOptions(*options, table);
}

}  // namespace lyrefit
