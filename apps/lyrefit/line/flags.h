#pragma once

#include <glog/logging.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "command_line.h"
#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/option.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/estimate/fit/text_readers.h"
#include "lyrefit/read/condition_options.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/report/document.h"
#include "lyrefit/report/figure.h"
#include "lyrefit/report/json.h"
#include "output.h"

namespace lyrefit {

// What reads the texts of options that need a file or the catalogue of effects (fit_forms.h).
const TextReaders& ProgramTextReaders();

// Help text of a row: "doc: texts allowed [lower, upper] (default value)". `defaults` holds the
// values before parsing. Very wide ranges are left out.
template <class Options>
std::string RowHelp(const OptionRow<Options>& row, const Options& defaults) {
  std::string help = row.doc;
  const auto* const text = std::get_if<OptionText<Options>>(&row.field);
  if (text != nullptr && text->allowed != nullptr) help += ": " + text->allowed();
  if (row.Is(OptionTrait::kNoDefault) || IsList(row)) return help;
  if (row.usual != nullptr) return help + " (default" + row.usual + ")";
  if (text != nullptr) {
    const std::vector<std::string> usual = text->write(defaults);
    return usual.empty() ? help : help + " (default " + usual.front() + ")";
  }
  const bool ranged = !row.Is(OptionTrait::kQuiet) && row.lower > -kOverflowCode;
  std::visit(
      [&](const auto& field) {
        if constexpr (IsNumberField<std::decay_t<decltype(field)>>::value) {
          if (ranged && row.upper < 1e12) {
            help += " [" + NumberText(row.lower) + ", " + NumberText(row.upper) + "]";
          }
          const auto value = defaults.*field;
          // Infinity and the largest integer mean "no limit".
          const bool none = std::fabs(static_cast<double>(value)) > 1e18;
          help += none ? " (default: none)" : " (default " + NumberText(value) + ")";
        }
      },
      row.field);
  return help;
}

// The name of a row's flag.
template <class Options>
std::string FlagName(const OptionRow<Options>& row, const Options& defaults) {
  const auto* const member = std::get_if<bool Options::*>(&row.field);
  const bool off = member != nullptr && defaults.*(*member);
  return std::string(off ? "--no-" : "--") + row.name;
}

// Declares the flag of one row, with its name, help, unit and range; also its group, unless that is
// empty.
template <class Options>
Flag AddRowFlag(VerbLine* verb, const OptionRow<Options>& row, const std::string& group,
                Options* options) {
  const std::string name = FlagName(row, *options);
  const std::string help = RowHelp(row, *options);
  const auto declare = [&](const auto& field) -> Flag {
    using Field = std::decay_t<decltype(field)>;
    if constexpr (std::is_same_v<Field, OptionText<Options>>) {
      const auto read = [options, read = field.read](const std::string& text) {
        return read(text, options, ProgramTextReaders());
      };
      Flag flag =
          field.many ? verb->AddListReader(name, read, help) : verb->AddReader(name, read, help);
      if (field.allowed != nullptr) flag.OneOf(field.allowed());
      return flag.Type(row.unit);
    } else if constexpr (std::is_same_v<Field, OptionSwitch<Options>>) {
      return verb->AddSwitch(
          name, [=, set = field.set] { set(options, true); }, help);
    } else if constexpr (std::is_same_v<Field, bool Options::*>) {
      if (!(options->*field)) return verb->AddSwitch(name, &(options->*field), help);
      return verb->AddSwitch(
          name, [=] { options->*field = false; }, help);
    } else if constexpr (std::is_member_pointer_v<Field>) {
      Flag flag = verb->AddOption(name, &(options->*field), help);
      flag.Type(*row.unit != '\0' ? row.unit : "NUMBER");
      if (IsList(row)) flag.OneEach();
      if constexpr (!IsNumberField<Field>::value && !IsOptionalField<Field>::value) return flag;
      if (row.Is(OptionTrait::kUnchecked)) return flag.Within(-kOverflowCode, kOverflowCode);
      const bool whole = std::is_same_v<Field, int Options::*> ||
                         std::is_same_v<Field, std::optional<int> Options::*>;
      if (!whole || !row.Is(OptionTrait::kQuiet)) return flag.Within(row.lower, row.upper);
      return flag.Between(static_cast<int>(row.lower), static_cast<int>(row.upper));
    } else {
      LOG(FATAL) << "the row '" << row.name << "' has no flag";
    }
  };
  Flag flag = std::visit(declare, row.field);
  if (row.Is(OptionTrait::kExperimental)) flag.Experimental();
  return group.empty() ? flag : flag.Group(group);
}

// Calls see(row, its heading) for every row that is not a heading.
template <class Table, class See>
void ForRows(const Table& table, const See& see) {
  std::string heading;
  for (const auto& row : table) {
    if (row.IsHeading()) {
      heading = row.name;
    } else {
      see(row, heading);
    }
  }
}

// The row of this name; nullptr if there is none.
template <class Table>
auto* FindRow(const Table& table, const std::string& name) {
  decltype(&table[0]) found = nullptr;
  ForRows(table, [&](const auto& row, const std::string&) {
    if (row.name == name) found = &row;
  });
  return found;
}

// Declares the flags of these rows in this order, each under its heading.
template <class Options, class Table>
void AddNamedFlags(VerbLine* verb, const Table& table, const std::vector<std::string>& names,
                   Options* options) {
  for (const std::string& name : names) {
    ForRows(table, [&](const OptionRow<Options>& row, const std::string& heading) {
      if (row.name == name) AddRowFlag(verb, row, heading, options);
    });
  }
}

// Declares the flags of all rows of an option table, or of those under one heading, that the verb
// has not declared yet.
template <class Options, class Table>
void AddTableFlags(VerbLine* verb, const Table& table, Options* options,
                   const std::string& only = "") {
  ForRows(table, [&](const OptionRow<Options>& row, const std::string& heading) {
    const bool nest = std::holds_alternative<OptionNest<Options>>(row.field);
    if (row.Is(OptionTrait::kNoFlag) || nest || (!only.empty() && heading != only)) return;
    if (!verb->Has(FlagName(row, *options))) AddRowFlag(verb, row, heading, options);
  });
}

// --resume FILE: the file to which a study appends each run (or set), and from which it resumes.
Flag AddResumeFlag(VerbLine* verb, const std::string& unit, std::string* target);

// Parses "0:0.6:50", given to `flag`: 50 even steps, both ends included.
Expected<std::vector<double>> ParseSteps(const std::string& flag, const std::string& text);

// ApplyConditions(), with errors that name the flag.
Expected<void> ApplyConditionFlags(const ConditionOptions& flags, IvCurve* curve);
// ApplyConditionFlags for every curve of a set.
Expected<void> ApplyConditionFlags(const ConditionOptions& flags, CurveSet* set);

// Flags of one curve.
struct CurveFlags {
  std::string file;
  std::optional<int> index;
  ReadOptions reading;  // except the index
  bool list_columns = false;
  ConditionOptions conditions;
};

// Declares --list-columns and the flags that select columns of a table and the area that converts
// current densities to currents.
void AddColumnFlags(VerbLine* verb, ReadOptions* options, bool* list_columns);

// Prints what every file holds to standard output, as the verb inspect does; returns the exit code.
Expected<int> PrintInspections(const std::vector<std::string>& files, const ReadOptions& options);

// A curve from a file or folder, or from standard input if `file` is "-".
Expected<IvCurve> ReadCurveOrInput(const std::string& file, const ReadOptions& options);

// A measurement by ReadMeasurement, or the one curve of standard input.
Expected<CurveSet> ReadMeasurementOrInput(const std::string& file, const ReadOptions& options);

void AddCurveFlags(VerbLine* verb, CurveFlags* flags);
// Declares the flags of one curve without the file.
void AddReadingFlags(VerbLine* verb, CurveFlags* flags);
Expected<IvCurve> ReadFlaggedCurve(const CurveFlags& flags);

inline constexpr char kModuleHelp[] =
    "JSON with what the sheet of a module says: rated_power_W, gamma_pmp_percent_K, "
    "technology and coefficients; or a PVsyst .PAN file, or a row of SAM's library of modules "
    "(FILE#NAME); flags go before it";

// Output flags of a verb with a report.
struct ReportFlags {
  std::string json_file;
  std::string csv_file;
  std::string plot_file;
  std::string html_file;
  bool brief = false;
  bool full_json = false;
  bool full_plot = false;
  JsonPoints points() const { return full_json ? JsonPoints::kAll : JsonPoints::kThinned; }
  PlotPoints marks() const { return full_plot ? PlotPoints::kAll : PlotPoints::kThinned; }
};

// --full-json and --full-plot, for a verb whose JSON repeats the readings and whose pictures show
// them.
void AddFullSwitches(VerbLine* verb, ReportFlags* flags);
// --json, --csv (`table` describes its content), --plot, --html, --brief and --quiet. `what` names
// the report in the help, `picture` the plot.
void AddReportFlags(VerbLine* verb, const std::string& what, const std::string& table,
                    const std::string& picture, ReportFlags* flags);
void AddCsvFlag(VerbLine* verb, const std::string& table, ReportFlags* flags);
void AddHtmlFlag(VerbLine* verb, const std::string& what, ReportFlags* flags);

// Writes a requested file; `make` is called only if `file` is not empty.
template <class Make>
Expected<void> WriteWanted(const std::string& file, const Make& make) {
  return file.empty() ? Expected<void>() : WriteOutput(file, make());
}
template <class Draw>
Expected<void> DrawWanted(const std::string& file, const Draw& draw) {
  return file.empty() ? Expected<void>() : draw(file);
}
// The length of the text that is wanted.
inline Length LengthWanted(const VerbLine& verb) {
  return verb.Whole() ? Length::kWhole : Length::kShort;
}
// Writes the text to standard output, unless an output file uses it or --quiet is given.
template <class Make>
Expected<void> WriteText(const VerbLine& verb, const Make& make) {
  return verb.TextWanted() ? WriteOutput("-", make()) : Expected<void>();
}

}  // namespace lyrefit
