#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "errors.h"
#include "lyrefit/base/option.h"
#include "lyrefit/simulate/text_readers.h"

// Keyword arguments from the option tables: the command's --memory-rate is memory_rate here, with
// the same range and error messages.
namespace lyrefit::python {

namespace py = pybind11;

// The keyword of a row: '-' becomes '_'. A few differ: they have pvlib's name, or avoid a Python
// keyword.
std::string KeywordOf(std::string_view row);
// Whether KeywordOf(row) == keyword, without an allocation.
bool IsKeywordOf(std::string_view row, std::string_view keyword);

// Converts a value, or raises ValueError "memory_rate: expected a number, found 'much'".
double NumberOf(const std::string& keyword, py::handle value);
std::int64_t WholeOf(const std::string& keyword, py::handle value);
std::uint64_t UnsignedOf(const std::string& keyword, py::handle value);
bool TruthOf(const std::string& keyword, py::handle value);
std::string TextOf(const std::string& keyword, py::handle value);  // a str, a path, a number
// Converts a value to the texts of the command line: {"Rs": (0, 0.5)} to "Rs=0:0.5", {"shading":
// {"d": 0.3}} to "shading:d=0.3", a list to the texts of its members.
std::vector<std::string> TextsOf(const std::string& keyword, py::handle value);

// Documentation of a keyword for docstrings and stubs.
struct KeywordNote {
  std::string name;
  std::string type;     // Python type: "int", "bool", "str | Mapping[str, float]"
  std::string usual;    // default, in Python notation
  std::string heading;  // of the option table
  std::string doc;      // empty: described in the head of the docstring
};

// Raises the command's error if the value is outside the range.
void CheckRange(const std::string& keyword, double value, double lower, double upper);

// Sets the field of a row.
template <class Options>
void SetField(const OptionRow<Options>& row, py::handle value, Options* options) {
  const std::string keyword = KeywordOf(row.name);
  const auto set = [&](const auto& field) {
    using Field = std::decay_t<decltype(field)>;
    const bool checked = !row.Is(OptionTrait::kUnchecked);
    const auto in_range = [&](auto number) {
      if (checked) CheckRange(keyword, static_cast<double>(number), row.lower, row.upper);
      return number;
    };
    if constexpr (std::is_same_v<Field, OptionText<Options>>) {
      const std::vector<std::string> texts = TextsOf(keyword, value);
      const auto read = [&](const std::string& text) {
        const Expected<void> done = field.read(text, options, AllTextReaders());
        if (!done) Raise({keyword + ": " + done.error().ToString(), {}});
      };
      if (field.many) {
        for (const std::string& text : texts) read(text);
      } else {
        read(JoinList(texts));
      }
    } else if constexpr (std::is_same_v<Field, OptionSwitch<Options>>) {
      field.set(options, TruthOf(keyword, value));
    } else if constexpr (std::is_same_v<Field, bool Options::*>) {
      options->*field = TruthOf(keyword, value);
    } else if constexpr (std::is_same_v<Field, std::string Options::*>) {
      options->*field = TextOf(keyword, value);
    } else if constexpr (std::is_same_v<Field, std::vector<std::string> Options::*>) {
      options->*field = TextsOf(keyword, value);
    } else if constexpr (std::is_same_v<Field, double Options::*> ||
                         std::is_same_v<Field, std::optional<double> Options::*>) {
      options->*field = in_range(NumberOf(keyword, value));
    } else if constexpr (std::is_same_v<Field, std::uint64_t Options::*>) {
      options->*field = in_range(UnsignedOf(keyword, value));
    } else if constexpr (std::is_same_v<Field, std::int64_t Options::*>) {
      options->*field = in_range(WholeOf(keyword, value));
    } else if constexpr (std::is_same_v<Field, int Options::*> ||
                         std::is_same_v<Field, std::optional<int> Options::*>) {
      const std::int64_t whole = in_range(WholeOf(keyword, value));
      CheckRange(keyword, static_cast<double>(whole), -2147483648.0, 2147483647.0);
      options->*field = static_cast<int>(whole);
    }
  };
  std::visit(set, row.field);
}

// Whether a keyword can set a row. Excluded are headings, nested tables, rows that cannot be
// parsed, and `set`, whose parameters are arguments of their own here.
template <class Options>
bool HasKeyword(const OptionRow<Options>& row) {
  if (row.IsHeading() || std::holds_alternative<OptionNest<Options>>(row.field)) return false;
  const auto* const text = std::get_if<OptionText<Options>>(&row.field);
  return (text == nullptr || text->read != nullptr) && std::string_view(row.name) != "set";
}

// The keyword arguments of one call. Each reader takes its own; Finish() rejects the rest.
class Keywords {
 public:
  Keywords(const char* verb, const py::kwargs& given);

  // The value of `name`, if given and not None; marks it as taken.
  std::optional<py::object> Take(const char* name);

  // Sets the fields of all rows with a given keyword; None leaves the default.
  template <class Table, class Options>
  void Read(const Table& table, Options* options) {
    knowers_.push_back([&table](std::vector<std::string>* names) {
      for (const OptionRow<Options>& row : table) {
        if (HasKeyword(row)) names->push_back(KeywordOf(row.name));
      }
    });
    for (Argument& given : given_) {
      if (given.taken) continue;
      for (const OptionRow<Options>& row : table) {
        if (!HasKeyword(row) || !IsKeywordOf(row.name, given.name)) continue;
        given.taken = true;
        if (!given.value.is_none()) SetField(row, given.value, options);
        break;
      }
    }
  }

  // Whether `name` was given (and is not None), taken or not.
  bool Given(std::string_view name) const;

  // TypeError: fit() has no keyword 'memory'; did you mean 'memory_rate'?
  void Finish() const;

 private:
  struct Argument {
    std::string name;
    py::object value;
    bool taken = false;
  };
  const char* verb_;
  std::vector<Argument> given_;
  std::vector<const char*> asked_;
  std::vector<std::function<void(std::vector<std::string>*)>> knowers_;
};

bool IsNoted(const std::string& keyword, const std::vector<KeywordNote>& notes);

// Appends notes for those rows of a table that have none yet, for docstrings and stubs.
template <class Options, class Table>
void AppendNotes(const Table& table, const Options& defaults, std::vector<KeywordNote>* notes) {
  std::string heading;
  for (const OptionRow<Options>& row : table) {
    if (row.IsHeading()) heading = row.name;
    if (!HasKeyword(row) || IsNoted(KeywordOf(row.name), *notes)) continue;
    KeywordNote note{KeywordOf(row.name), "str", "None", heading, row.doc};
    const auto number = [&](const char* type) {
      note.type = type;
      const std::vector<std::string> texts = OptionTexts(row, defaults);
      if (!texts.empty() && texts[0].find_first_of("in") == std::string::npos) {
        note.usual = texts[0];
      }
    };
    const auto describe = [&](const auto& field) {
      using Field = std::decay_t<decltype(field)>;
      if constexpr (std::is_same_v<Field, OptionText<Options>>) {
        if (field.many) {
          note.type = "str | Sequence[Any] | Mapping[str, Any]";
        } else if (field.allowed == nullptr) {
          note.type = "str | float | Sequence[Any]";
        }
        if (field.allowed != nullptr) note.doc += ": " + field.allowed();
        const std::vector<std::string> usual = field.write(defaults);
        if (!field.many && usual.size() == 1 && !usual[0].empty()) {
          note.usual = "'" + usual[0] + "'";
        }
      } else if constexpr (std::is_same_v<Field, OptionSwitch<Options>>) {
        note.type = "bool";
        note.usual = field.get(defaults) ? "True" : "False";
      } else if constexpr (std::is_same_v<Field, bool Options::*>) {
        note.type = "bool";
        note.usual = defaults.*field ? "True" : "False";
        // The help text of the row describes the flag --no-NAME.
        if (defaults.*field && !row.Is(OptionTrait::kNoFlag)) note.doc = "False: " + note.doc;
      } else if constexpr (std::is_same_v<Field, double Options::*> ||
                           std::is_same_v<Field, std::optional<double> Options::*>) {
        number("float");
      } else if constexpr (std::is_same_v<Field, std::vector<std::string> Options::*>) {
        note.type = "str | Sequence[str]";
      } else if constexpr (!std::is_same_v<Field, std::string Options::*>) {
        number("int");
      }
    };
    std::visit(describe, row.field);
    if (note.name == "with_") note.type = "Effect | " + note.type;
    if (*row.unit != '\0' && (note.type == "float" || note.type == "int")) {
      note.doc += std::string(" (") + row.unit + ")";
    }
    if (row.lower > -1e300 && row.upper < 1e12 && !row.Is(OptionTrait::kUnchecked)) {
      note.doc += " [" + NumberText(row.lower) + ", " + NumberText(row.upper) + "]";
    }
    if (row.Is(OptionTrait::kExperimental)) note.doc += std::string("; ") + kExperimentalNote;
    notes->push_back(std::move(note));
  }
}

}  // namespace lyrefit::python
