#pragma once

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
#include "lyrefit/curve/read_curve.h"
#include "lyrefit/fit/fit.h"
#include "lyrefit/law/extension.h"
#include "lyrefit/report/json.h"

namespace lyrefit {

// `text` as one of an enumeration's texts.
template <class E>
Expected<E> ParseEnum(const std::string& text) {
  const std::optional<E> value = FromText<E>(text);
  if (!value) return Fail("expected one of " + AllTexts<E>() + ", found '" + text + "'");
  return *value;
}

// Reads one of an enumeration's texts into `target`, an E or a std::optional<E>.
template <class E, class Target>
FlagReader EnumReader(Target* target) {
  return [target](const std::string& text) -> Expected<void> {
    const Expected<E> value = ParseEnum<E>(text);
    if (!value) return tl::unexpected(value.error());
    *target = *value;
    return {};
  };
}

// A flag that takes one of an enumeration's texts.
template <class E>
Flag AddEnumFlag(Verb* verb, const std::string& flag, const std::string& doc, E* target) {
  const std::string help = doc + ": " + AllTexts<E>() + " (default " + ToText(*target) + ")";
  return verb->AddReader(flag, EnumReader<E>(target), help).Type("NAME");
}

// "doc [lower, upper] (default value)"; a range that is hardly a limit is left out.
template <class Options>
std::string RowHelp(const OptionRow<Options>& row, const Options& defaults) {
  std::string help = row.doc;
  if (std::isfinite(row.lower) && row.upper < 1e12) {
    help += " [" + NumberText(row.lower) + ", " + NumberText(row.upper) + "]";
  }
  std::visit(
      [&](auto field) {
        const auto value = defaults.*field;
        // Infinity, or the largest whole number, stands for "no limit".
        const bool none = std::fabs(static_cast<double>(value)) > 1e18;
        help += none ? " (default: none)" : " (default " + NumberText(value) + ")";
      },
      row.field);
  return help;
}

// One flag for every row of an option table: name, help, unit and range come from the row.
template <class Options, class Table>
void AddTableFlags(Verb* verb, const Table& table, const std::string& group, Options* options) {
  const Options defaults;
  for (const OptionRow<Options>& row : table) {
    const FlagTarget target =
        std::visit([options](auto field) { return FlagTarget(&(options->*field)); }, row.field);
    verb->AddOption(std::string("--") + row.name, target, RowHelp(row, defaults))
        .Within(row.lower, row.upper)
        .Type(*row.unit != '\0' ? row.unit : "NUMBER")
        .Group(group);
  }
}

// --resume FILE: where a study is written to run by run (or set by set), and taken up from.
Flag AddResumeFlag(Verb* verb, const std::string& unit, std::string* target);

// --birds, of the verbs that search curves.
Flag AddBirdsFlag(Verb* verb, Birds* target);

// A flag that may be given several times, one value each.
Flag AddListFlag(Verb* verb, const std::string& flag, const std::string& doc,
                 std::vector<std::string>* target);

// "Rs=0:0.5" given to `flag`, as symbol, lower and upper.
Expected<std::pair<std::string, std::pair<double, double>>> ParseRange(const std::string& flag,
                                                                       const std::string& text);

// "n2=2" given to `flag`, as symbol and value.
Expected<std::pair<std::string, double>> ParseAssignment(const std::string& flag,
                                                         const std::string& text);

// --with EFFECT[:NAME=VALUE|LOW:HIGH,...], once for each.
Flag AddWithFlag(Verb* verb, const std::string& group, std::vector<std::string>* target);
Expected<std::vector<EffectUse>> ParseWith(const std::vector<std::string>& texts);

// "0:0.6:50" given to `flag`: that many even steps, both ends included.
Expected<std::vector<double>> ParseSteps(const std::string& flag, const std::string& text);

// What the person at the terminal says about the measurement; it goes before any file.
struct ConditionFlags {
  std::optional<int> cells;
  std::optional<double> temperature_C;
  std::optional<double> irradiance_W_m2;
  bool as_is = false;
};

void AddConditionFlags(Verb* verb, ConditionFlags* flags);

// Checks the flags and puts them into `curve`, where they replace what was assumed.
Expected<void> ApplyConditionFlags(const ConditionFlags& flags, IvCurve* curve);
// The same for every curve of a set.
Expected<void> ApplyConditionFlags(const ConditionFlags& flags, CurveSet* set);

// One curve and what is said about it.
struct CurveFlags {
  std::string file;
  std::optional<int> index;
  ReadOptions reading;  // without the index
  bool list_columns = false;
  ConditionFlags conditions;
};

// Which columns of a table are read, and the area that makes currents of densities.
void AddColumnFlags(Verb* verb, ReadOptions* options, bool* list_columns);

// The columns of every file and what each is read as, on standard output; the exit code.
int PrintColumns(const std::vector<std::string>& files, const ReadOptions& options);

// A curve from a file or folder, or from standard input where `file` is "-".
Expected<IvCurve> ReadCurveOrInput(const std::string& file, const ReadOptions& options);

void AddCurveFlags(Verb* verb, CurveFlags* flags);
// The same without the file.
void AddReadingFlags(Verb* verb, CurveFlags* flags);
Expected<IvCurve> ReadFlaggedCurve(const CurveFlags& flags);

// What a verb on one curve writes.
struct ReportFlags {
  std::string json_file;
  std::string plot_file;
  bool brief = false;
  bool full_json = false;
  JsonPoints points() const { return full_json ? JsonPoints::kAll : JsonPoints::kThinned; }
};

// --full-json, where the JSON of a fit repeats its readings.
void AddFullJsonSwitch(Verb* verb, ReportFlags* flags);
// `what` names the report in the help, `picture` the plot.
void AddReportFlags(Verb* verb, const std::string& what, const std::string& picture,
                    ReportFlags* flags);

}  // namespace lyrefit
