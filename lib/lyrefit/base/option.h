#pragma once

#include <cstdint>
#include <sstream>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "lyrefit/base/error.h"

namespace lyrefit {

// One field of an options struct. The table of an algorithm's rows is its only description: checks,
// --help, flags and the echo of non-defaults in reports all walk it.
template <class Options>
struct OptionRow {
  using Field = std::variant<int Options::*, std::int64_t Options::*, std::uint64_t Options::*,
                             double Options::*>;
  const char* name;  // in flags and JSON, lower case with '-'
  const char* unit;  // "" for pure numbers
  const char* doc;   // one line
  Field field;
  double lower;  // smallest and largest value allowed, both included
  double upper;
};

// A value that differs from its default, as reports echo it.
struct OptionEcho {
  std::string name;
  std::string value;
  std::string default_value;
};

// Plain decimal text, as short as reads back to 15 digits.
template <class T>
std::string NumberText(T value) {
  std::ostringstream text;
  text.precision(15);
  text << value;
  return text.str();
}

// The first field outside its range, as a sentence.
template <class Options, class Table>
Expected<void> ValidateOptions(const Options& options, const Table& table) {
  for (const OptionRow<Options>& row : table) {
    const auto check = [&](auto field) -> Expected<void> {
      const double value = static_cast<double>(options.*field);
      if (value >= row.lower && value <= row.upper) return {};
      return Fail(std::string(row.name) + " = " + NumberText(options.*field) + " is outside [" +
                  NumberText(row.lower) + ", " + NumberText(row.upper) + "]");
    };
    if (auto checked = std::visit(check, row.field); !checked) return checked;
  }
  return {};
}

template <class Options, class Table>
void AppendNonDefaults(const Options& options, const Options& defaults, const Table& table,
                       std::vector<OptionEcho>* echoes) {
  for (const OptionRow<Options>& row : table) {
    std::visit(
        [&](auto field) {
          if (options.*field == defaults.*field) return;
          echoes->push_back({row.name, NumberText(options.*field), NumberText(defaults.*field)});
        },
        row.field);
  }
}

template <class Options, class Table>
void AppendNonDefaults(const Options& options, const Table& table,
                       std::vector<OptionEcho>* echoes) {
  static const Options defaults;
  AppendNonDefaults(options, defaults, table, echoes);
}

}  // namespace lyrefit
