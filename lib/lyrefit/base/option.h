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
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// A value that differs from its default, as reports echo it.
struct OptionEcho {
  std::string name;           // as in flags and JSON
  std::string value;          // as a flag would say it
  std::string default_value;  // the same of the default
};

// A field that is told by text: an enumeration, a list, a map, what a file says.
template <class Options>
struct OptionText {
  // What a text means for the options; an error is a sentence without the option's name. None: the
  // option can be set in code alone.
  Expected<void> (*read)(const std::string& text, Options* options) = nullptr;
  // The texts that say what the options hold: one, or of `many` as many as there are.
  std::vector<std::string> (*write)(const Options& options) = nullptr;
  std::string (*allowed)() = nullptr;  // "sd, dd, td", for --help; none: the doc line says it
  bool many = false;                   // given once for each
};

// A switch that is no member of the options themselves.
template <class Options>
struct OptionSwitch {
  // Whether it is on.
  bool (*get)(const Options& options);
  // Turns it on or off.
  void (*set)(Options* options, bool on);
};

// Options inside of options, with a table of their own.
template <class Options>
struct OptionNest {
  // Appends those that differ.
  void (*echo)(const Options& options, const Options& defaults, std::vector<OptionEcho>* echoes);
};

// What is special about a row.
enum class OptionTrait : unsigned {
  kNone = 0,
  kNoFlag = 1,     // has none of its own, or one that a verb declares
  kNoEcho = 2,     // never changes a result, or reports say it anyway
  kQuiet = 4,      // its range is a flag's alone, and --help does not print it
  kUnchecked = 8,  // whoever uses it says in its own words what it has to be
  kNoDefault = 16  // --help prints none
};
constexpr OptionTrait operator|(OptionTrait a, OptionTrait b) {
  return static_cast<OptionTrait>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}

// One field of an options struct. The table of a struct's rows is its only description: checks,
// --help, flags, manual, completion and the echo of non-defaults in reports all walk it. A row with
// nothing but a name is the heading of those that follow. An option that is true by default has the
// flag --no-NAME.
template <class Options>
struct OptionRow {
  // Where a value lies, and of which type it is; monostate: nowhere.
  using Field = std::variant<std::monostate, int Options::*, std::int64_t Options::*,
                             std::uint64_t Options::*, double Options::*, bool Options::*,
                             std::string Options::*, std::vector<std::string> Options::*,
                             std::optional<int> Options::*, std::optional<double> Options::*,
                             OptionText<Options>, OptionSwitch<Options>, OptionNest<Options>>;

  // A heading of the rows that follow.
  constexpr explicit OptionRow(const char* heading) : name(heading) {}
  // A field of any type; of numbers, any number is allowed.
  constexpr OptionRow(const char* its_name, const char* its_unit, const char* line, Field at,
                      OptionTrait its = OptionTrait::kNone, const char* by_default = nullptr)
      : name(its_name), unit(its_unit), doc(line), field(at), traits(its), usual(by_default) {}
  // A number from `least` to `most`.
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
  // Whether it is a heading.
  constexpr bool IsHeading() const { return std::holds_alternative<std::monostate>(field); }

  const char* name;       // in flags and JSON, lower case with '-'
  const char* unit = "";  // or what --help shows for the value; "" for pure numbers
  const char* doc = "";   // one line
  Field field;
  double lower = -kInfinity;  // smallest and largest number allowed, both included
  double upper = kInfinity;
  OptionTrait traits = OptionTrait::kNone;
  const char* usual = nullptr;  // what --help says behind "(default" in the place of the value
};

// Whether a row's field is a plain number.
template <class Field>
struct IsNumberField : std::false_type {};
template <class Options, class T>
struct IsNumberField<T Options::*>
    : std::bool_constant<std::is_arithmetic_v<T> && !std::is_same_v<T, bool>> {};

// Plain decimal text, as short as reads back to 15 digits.
template <class T>
std::string NumberText(T value) {
  std::ostringstream text;
  text.precision(15);
  text << value;
  return text.str();
}

// The texts that say what a field holds: one, none if it is unset, or of lists as many as there
// are.
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
        } else if constexpr (std::is_member_pointer_v<Field>) {  // of optional numbers
          if (!(options.*field)) return {};
          return {NumberText(*(options.*field))};
        } else {
          return {};
        }
      },
      row.field);
}

// Whether a field is a list, which echoes each of its members.
template <class Options>
bool IsList(const OptionRow<Options>& row) {
  if (const auto* text = std::get_if<OptionText<Options>>(&row.field)) return text->many;
  return std::holds_alternative<std::vector<std::string> Options::*>(row.field);
}

// The first number outside its range, as a sentence.
template <class Options, class Table>
Expected<void> ValidateOptions(const Options& options, const Table& table) {
  for (const OptionRow<Options>& row : table) {
    if (row.Is(OptionTrait::kQuiet) || row.Is(OptionTrait::kUnchecked)) continue;
    const auto check = [&](const auto& field) -> Expected<void> {
      if constexpr (IsNumberField<std::decay_t<decltype(field)>>::value) {
        const double value = static_cast<double>(options.*field);
        if (value >= row.lower && value <= row.upper) return {};
        return Fail(std::string(row.name) + " = " + NumberText(options.*field) + " is outside [" +
                    NumberText(row.lower) + ", " + NumberText(row.upper) + "]");
      } else {
        return {};
      }
    };
    if (auto checked = std::visit(check, row.field); !checked) return checked;
  }
  return {};
}

// Appends the options that differ from `defaults`, in the table's order.
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

// The same with the defaults of a new struct.
template <class Options, class Table>
void AppendNonDefaults(const Options& options, const Table& table,
                       std::vector<OptionEcho>* echoes) {
  static const Options defaults;
  AppendNonDefaults(options, defaults, table, echoes);
}

// The options that are not at their defaults.
template <class Options, class Table>
std::vector<OptionEcho> NonDefaults(const Options& options, const Table& table) {
  std::vector<OptionEcho> echoes;
  AppendNonDefaults(options, table, &echoes);
  return echoes;
}

// "a,b" as its parts; empty parts are refused.
Expected<std::vector<std::string>> SplitList(const std::string& text);
// The same the other way round.
std::string JoinList(const std::vector<std::string>& parts);

// Where a text's field lies: Along<&FitOptions::search, &SearchOptions::algorithm>(options).
template <auto First, auto... Rest, class Options>
auto& Along(Options& options) {
  return ((options.*First).*....*Rest);
}

// The class of a pointer to a member.
template <class Member>
struct MemberParts;
template <class C, class T>
struct MemberParts<T C::*> {
  using Class = C;  // whose member it is
};
template <auto Member>
using ClassOf = typename MemberParts<decltype(Member)>::Class;

// What an optional holds, and any other type itself.
template <class T>
struct WithoutOptional {
  using Type = T;  // without it
};
template <class T>
struct WithoutOptional<std::optional<T>> {
  using Type = T;  // what it holds
};

// An enumeration, or one that may be unset.
template <auto First, auto... Rest>
constexpr auto EnumOption() {
  using Options = ClassOf<First>;
  using Target = std::decay_t<decltype(Along<First, Rest...>(std::declval<Options&>()))>;
  using E = typename WithoutOptional<Target>::Type;
  return OptionText<Options>{
      [](const std::string& text, Options* options) -> Expected<void> {
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

// A switch inside of nested options.
template <auto First, auto... Rest>
constexpr auto SwitchOption() {
  using Options = ClassOf<First>;
  return OptionSwitch<Options>{
      [](const Options& options) -> bool { return Along<First, Rest...>(options); },
      [](Options* options, bool on) { Along<First, Rest...>(*options) = on; }};
}

// Several of an enumeration, as a list with commas.
template <auto First, auto... Rest>
constexpr auto EnumListOption() {
  using Options = ClassOf<First>;
  using Target = std::decay_t<decltype(Along<First, Rest...>(std::declval<Options&>()))>;
  using E = typename Target::value_type;
  return OptionText<Options>{
      [](const std::string& text, Options* options) -> Expected<void> {
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
