#pragma once

#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

struct TextReaders;

// An option whose value differs from its default, for the echo in reports.
struct OptionEcho {
  std::string name;           // as in flags and JSON
  std::string value;          // as the flag's argument
  std::string default_value;  // the default, as the flag's argument
};

// A field that is set from text: an enumeration, a list, a map or a file's content.
template <class Options>
struct OptionText {
  // Parses a text into the options. `readers` reads what needs a file or a catalogue
  // (estimate/fit/text_readers.h). An error is a sentence without the option's name. Null: the
  // option can be set in code only.
  Expected<void> (*read)(const std::string& text, Options* options,
                         const TextReaders& readers) = nullptr;
  // Formats the field as text: one text, or one for each element if `many`.
  std::vector<std::string> (*write)(const Options& options) = nullptr;
  std::string (*allowed)() = nullptr;  // list of values for --help, "sd, dd, td"; null: the doc
                                       // line names them
  bool many = false;                   // the flag may be repeated, once for each element
};

// A switch that is not itself a member of the options.
template <class Options>
struct OptionSwitch {
  // Whether it is on.
  bool (*get)(const Options& options);
  // Turns it on or off.
  void (*set)(Options* options, bool on);
};

// Options nested inside other options, with their own table.
template <class Options>
struct OptionNest {
  // Appends the nested options that differ from their defaults.
  void (*echo)(const Options& options, const Options& defaults, std::vector<OptionEcho>* echoes);
};

// What help says of options and verbs that are not promised within a major version (data/stable).
inline constexpr char kExperimentalNote[] = "experimental: may change in a minor version";

// Special treatment of a row.
enum class OptionTrait : unsigned {
  kNone = 0,
  kNoFlag = 1,        // no flag, or a flag that a command declares itself
  kNoEcho = 2,        // not echoed: it never changes a result, or reports state it already
  kQuiet = 4,         // the range applies to the flag only; --help does not print it
  kUnchecked = 8,     // ValidateOptions skips the row: the code that uses the option checks it, and
                      // the flag takes any number that is finite
  kNoDefault = 16,    // --help prints no default
  kExperimental = 32  // may change in a minor version (data/stable); --help and docstrings say so
};
constexpr OptionTrait operator|(OptionTrait a, OptionTrait b) {
  return static_cast<OptionTrait>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}

// One field of an options struct. The table of rows is the only description of the struct. Checks,
// flags, --help, the manual, completion and the echo in reports all use it. A row with only a name
// is the heading of the rows after it. An option that is true by default has the flag --no-NAME.
template <class Options>
struct OptionRow {
  // Pointer to the field, which also fixes its type; monostate: no field (a heading).
  using Field = std::variant<std::monostate, int Options::*, std::int64_t Options::*,
                             std::uint64_t Options::*, double Options::*, bool Options::*,
                             std::string Options::*, std::vector<std::string> Options::*,
                             std::optional<int> Options::*, std::optional<double> Options::*,
                             OptionText<Options>, OptionSwitch<Options>, OptionNest<Options>>;

  // A heading of the following rows.
  constexpr explicit OptionRow(const char* heading) : name(heading) {}
  // A field of any type. A number may have any value that is no code of an overflow.
  constexpr OptionRow(const char* its_name, const char* its_unit, const char* line, Field at,
                      OptionTrait its = OptionTrait::kNone, const char* by_default = nullptr)
      : name(its_name), unit(its_unit), doc(line), field(at), traits(its), usual(by_default) {}
  // A number in [least, most]; an optional one may be unset too.
  constexpr OptionRow(const char* its_name, const char* its_unit, const char* line, Field at,
                      double least, double most, OptionTrait its = OptionTrait::kNone)
      : name(its_name),
        unit(its_unit),
        doc(line),
        field(at),
        lower(least),
        upper(most),
        traits(its) {}

  // Whether the row has this trait.
  constexpr bool Is(OptionTrait trait) const {
    return (static_cast<unsigned>(traits) & static_cast<unsigned>(trait)) != 0;
  }
  // Whether the row is a heading.
  constexpr bool IsHeading() const { return std::holds_alternative<std::monostate>(field); }

  const char* name;       // in flags and JSON, lower case with '-'
  const char* unit = "";  // or the placeholder of the value in --help; "" for pure numbers
  const char* doc = "";   // one line
  Field field;
  double lower = -kOverflowCode;  // smallest and largest allowed number, both included
  double upper = kOverflowCode;
  OptionTrait traits = OptionTrait::kNone;
  const char* usual = nullptr;  // text that --help prints as the default instead of the value
};

// Whether a row's field is a number (arithmetic, not bool).
template <class Field>
struct IsNumberField : std::false_type {};
template <class Options, class T>
struct IsNumberField<T Options::*>
    : std::bool_constant<std::is_arithmetic_v<T> && !std::is_same_v<T, bool>> {};

template <class Field>
struct IsOptionalField : std::false_type {};
template <class Options, class T>
struct IsOptionalField<std::optional<T> Options::*> : std::true_type {};

// Decimal text with up to 15 significant digits.
template <class T>
std::string NumberText(T value) {
  std::ostringstream text;
  text.precision(15);
  text << value;
  return text.str();
}

// Formats a field as text: one text, none for an unset optional, one for each element of a list.
template <class Options>
std::vector<std::string> OptionTexts(const OptionRow<Options>& row, const Options& options) {
  return std::visit(
      [&](const auto& field) -> std::vector<std::string> {
        using Field = std::decay_t<decltype(field)>;
        if constexpr (std::is_same_v<Field, OptionText<Options>>) {
          return field.write(options);
        } else if constexpr (IsNumberField<Field>::value) {
          return {NumberText(options.*field)};
        } else if constexpr (std::is_same_v<Field, OptionSwitch<Options>>) {
          return {field.get(options) ? "yes" : "no"};
        } else if constexpr (std::is_same_v<Field, bool Options::*>) {
          return {options.*field ? "yes" : "no"};
        } else if constexpr (std::is_same_v<Field, std::string Options::*>) {
          return {options.*field};
        } else if constexpr (std::is_same_v<Field, std::vector<std::string> Options::*>) {
          return options.*field;
        } else if constexpr (std::is_member_pointer_v<Field>) {  // std::optional of a number
          if (!(options.*field)) return {};
          return {NumberText(*(options.*field))};
        } else {
          return {};
        }
      },
      row.field);
}

// Whether a field is a list, whose elements are echoed separately.
template <class Options>
bool IsList(const OptionRow<Options>& row) {
  if (const auto* text = std::get_if<OptionText<Options>>(&row.field)) return text->many;
  return std::holds_alternative<std::vector<std::string> Options::*>(row.field);
}

// Checks every number against its range, also those that are optional. The error names the first
// number outside; one that is none is in no range.
template <class Options, class Table>
Expected<void> ValidateOptions(const Options& options, const Table& table) {
  for (const OptionRow<Options>& row : table) {
    if (row.Is(OptionTrait::kQuiet) || row.Is(OptionTrait::kUnchecked)) continue;
    const auto check = [&](const auto& field) -> Expected<void> {
      using Field = std::decay_t<decltype(field)>;
      const auto within = [&](auto number) -> Expected<void> {
        const double value = static_cast<double>(number);
        if (value >= row.lower && value <= row.upper) return {};
        return Fail(std::string(row.name) + " = " + NumberText(number) + " is outside [" +
                    NumberText(row.lower) + ", " + NumberText(row.upper) + "]");
      };
      if constexpr (IsNumberField<Field>::value) return within(options.*field);
      if constexpr (IsOptionalField<Field>::value) {
        if (options.*field) return within(*(options.*field));
      }
      return {};
    };
    if (auto checked = std::visit(check, row.field); !checked) return checked;
  }
  return {};
}

// Appends the options that differ from `defaults`, in the table's order. The elements of a list are
// appended always.
template <class Options, class Table>
void AppendNonDefaults(const Options& options, const Options& defaults, const Table& table,
                       std::vector<OptionEcho>* echoes) {
  for (const OptionRow<Options>& row : table) {
    if (row.IsHeading() || row.Is(OptionTrait::kNoEcho)) continue;
    if (const auto* nest = std::get_if<OptionNest<Options>>(&row.field)) {
      nest->echo(options, defaults, echoes);
      continue;
    }
    const std::vector<std::string> values = OptionTexts(row, options);
    if (IsList(row)) {
      for (const std::string& value : values) echoes->push_back({row.name, value, ""});
      continue;
    }
    const std::vector<std::string> usual = OptionTexts(row, defaults);
    if (values == usual) continue;
    echoes->push_back({row.name, values.empty() ? "" : values[0], usual.empty() ? "" : usual[0]});
  }
}

// Compares with the defaults of a newly constructed struct.
template <class Options, class Table>
void AppendNonDefaults(const Options& options, const Table& table,
                       std::vector<OptionEcho>* echoes) {
  static const Options defaults;
  AppendNonDefaults(options, defaults, table, echoes);
}

// The options that differ from the defaults of a newly constructed struct, in the table's order.
template <class Options, class Table>
std::vector<OptionEcho> NonDefaults(const Options& options, const Table& table) {
  std::vector<OptionEcho> echoes;
  AppendNonDefaults(options, table, &echoes);
  return echoes;
}

// Splits a comma-separated list, "a,b". Errors: an empty element.
Expected<std::vector<std::string>> SplitList(const std::string& text);
// Joins the elements of a list with commas.
std::string JoinList(const std::vector<std::string>& parts);

// A reference to a nested field: Along<&FitOptions::search, &SearchOptions::algorithm>(options).
template <auto First, auto... Rest, class Options>
auto& Along(Options& options) {
  return ((options.*First).*....*Rest);
}

// Class is the class that a pointer to member belongs to.
template <class Member>
struct MemberParts;
template <class C, class T>
struct MemberParts<T C::*> {
  using Class = C;  // class of the member
};
template <auto Member>
using ClassOf = typename MemberParts<decltype(Member)>::Class;

// Type is the value type of an optional, and any other type itself.
template <class T>
struct WithoutOptional {
  using Type = T;  // T is not an optional
};
template <class T>
struct WithoutOptional<std::optional<T>> {
  using Type = T;  // value type of the optional
};

// Option for an enumeration or an optional enumeration.
template <auto First, auto... Rest>
constexpr auto EnumOption() {
  using Options = ClassOf<First>;
  using Target = std::decay_t<decltype(Along<First, Rest...>(std::declval<Options&>()))>;
  using E = typename WithoutOptional<Target>::Type;
  return OptionText<Options>{
      [](const std::string& text, Options* options, const TextReaders&) -> Expected<void> {
        const std::optional<E> value = FromText<E>(text);
        if (!value) return Fail("expected one of " + AllTexts<E>() + ", found '" + text + "'");
        Along<First, Rest...>(*options) = *value;
        return {};
      },
      [](const Options& options) -> std::vector<std::string> {
        const Target& value = Along<First, Rest...>(options);
        if constexpr (std::is_same_v<E, Target>) {
          return {ToText(value)};
        } else {
          if (!value) return {};
          return {ToText(*value)};
        }
      },
      [] { return AllTexts<E>(); }, false};
}

// Option for a switch inside nested options.
template <auto First, auto... Rest>
constexpr auto SwitchOption() {
  using Options = ClassOf<First>;
  return OptionSwitch<Options>{
      [](const Options& options) -> bool { return Along<First, Rest...>(options); },
      [](Options* options, bool on) { Along<First, Rest...>(*options) = on; }};
}

// Option for a comma-separated list of enumeration values.
template <auto First, auto... Rest>
constexpr auto EnumListOption() {
  using Options = ClassOf<First>;
  using Target = std::decay_t<decltype(Along<First, Rest...>(std::declval<Options&>()))>;
  using E = typename Target::value_type;
  return OptionText<Options>{
      [](const std::string& text, Options* options, const TextReaders&) -> Expected<void> {
        const Expected<std::vector<std::string>> names = SplitList(text);
        if (!names) return tl::unexpected<Error>(names.error());
        Target values;
        for (const std::string& name : *names) {
          const std::optional<E> value = FromText<E>(name);
          if (!value) return Fail("expected a list of " + AllTexts<E>() + ", found '" + name + "'");
          values.push_back(*value);
        }
        Along<First, Rest...>(*options) = std::move(values);
        return {};
      },
      [](const Options& options) -> std::vector<std::string> {
        std::vector<std::string> names;
        for (const E value : Along<First, Rest...>(options)) names.push_back(ToText(value));
        return {JoinList(names)};
      },
      nullptr, false};
}

}  // namespace lyrefit
