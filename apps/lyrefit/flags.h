#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/option.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// A flag that takes one of an enumeration's texts.
template <class E>
CLI::Option* AddEnumFlag(CLI::App* app, const std::string& flag, const std::string& doc,
                         E* target) {
  const auto parse = [flag, target](const std::string& text) {
    const std::optional<E> value = FromText<E>(text);
    if (!value) {
      throw CLI::ValidationError(flag,
                                 "expected one of " + AllTexts<E>() + ", found '" + text + "'");
    }
    *target = *value;
  };
  const std::string help = doc + ": " + AllTexts<E>() + " (default " + ToText(*target) + ")";
  return app->add_option_function<std::string>(flag, parse, help)->type_name("NAME");
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
void AddTableFlags(CLI::App* app, const Table& table, const std::string& group, Options* options) {
  const Options defaults;
  for (const OptionRow<Options>& row : table) {
    const std::string flag = std::string("--") + row.name;
    std::visit(
        [&](auto field) {
          const auto in_range = [&row](const std::string& text) {
            double value = 0;
            if (!CLI::detail::lexical_cast(text, value)) return std::string();
            if (value >= row.lower && value <= row.upper) return std::string();
            return text + " is outside [" + NumberText(row.lower) + ", " + NumberText(row.upper) +
                   "]";
          };
          app->add_option(flag, options->*field, RowHelp(row, defaults))
              ->check(in_range, "")
              ->type_name(*row.unit != '\0' ? row.unit : "NUMBER")
              ->group(group);
        },
        row.field);
  }
}

// A flag that may be given several times, one value each.
CLI::Option* AddListFlag(CLI::App* app, const std::string& flag, const std::string& doc,
                         std::vector<std::string>* target);

// "Rs=0:0.5" given to `flag`, as symbol, lower and upper.
Expected<std::pair<std::string, std::pair<double, double>>> ParseRange(const std::string& flag,
                                                                       const std::string& text);

// "n2=2" given to `flag`, as symbol and value.
Expected<std::pair<std::string, double>> ParseAssignment(const std::string& flag,
                                                         const std::string& text);

// "0:0.6:50" given to `flag`: that many even steps, both ends included.
Expected<std::vector<double>> ParseSteps(const std::string& flag, const std::string& text);

// What the person at the terminal says about the measurement; it goes before any file.
struct ConditionFlags {
  std::optional<int> cells;
  std::optional<double> temperature_C;
  std::optional<double> irradiance_W_m2;
};

void AddConditionFlags(CLI::App* app, ConditionFlags* flags);

// Checks the flags and puts them into `curve`, where they replace what was assumed.
Expected<void> ApplyConditionFlags(const ConditionFlags& flags, IvCurve* curve);
// The same for every curve of a set.
Expected<void> ApplyConditionFlags(const ConditionFlags& flags, CurveSet* set);

// One curve and what is said about it.
struct CurveFlags {
  std::string file;
  std::optional<int> index;
  ConditionFlags conditions;
};

void AddCurveFlags(CLI::App* app, CurveFlags* flags);
Expected<IvCurve> ReadFlaggedCurve(const CurveFlags& flags);

// What a verb on one curve writes.
struct ReportFlags {
  std::string json_file;
  std::string plot_file;
  bool brief = false;
  bool quiet = false;
  bool text() const { return !quiet && json_file != "-"; }
};

// `what` names the report in the help, `picture` the plot.
void AddReportFlags(CLI::App* app, const std::string& what, const std::string& picture,
                    ReportFlags* flags);
// Whether both files can be written; to be asked before the work.
Expected<void> CheckReportFlags(const ReportFlags& flags);

}  // namespace lyrefit
