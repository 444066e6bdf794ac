#include "flags.h"

#include <fmt/format.h>

#include "lyrefit/base/file.h"
#include "lyrefit/curve/number_text.h"
#include "lyrefit/curve/read_curve.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/report/plot.h"
#include "output.h"

namespace lyrefit {
namespace {

constexpr double kColdest_C = -100;
constexpr double kHottest_C = 150;
constexpr double kMostSteps = 1e6;

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find(separator, begin)) != std::string::npos; begin = end + 1) {
    parts.push_back(text.substr(begin, end - begin));
  }
  parts.push_back(text.substr(begin));
  return parts;
}

tl::unexpected<Error> Misread(const std::string& flag, const char* example,
                              const std::string& text) {
  return Fail(fmt::format("{}: expected {}, found '{}'", flag, example, text));
}

Expected<void> CheckConditionFlags(const ConditionFlags& flags) {
  if (flags.cells && *flags.cells < 1) {
    return Fail(fmt::format("--cells: expected at least 1 cell in series, found {}", *flags.cells));
  }
  if (flags.temperature_C && *flags.temperature_C > kHottest_C) {
    return Fail(
        fmt::format("--temperature-C: {} looks like kelvin: expected degrees Celsius, "
                    "{} to {}",
                    NumberText(*flags.temperature_C), kColdest_C, kHottest_C));
  }
  if (flags.temperature_C && !(*flags.temperature_C >= kColdest_C)) {
    return Fail(fmt::format("--temperature-C: expected degrees Celsius, {} to {}, found {}",
                            kColdest_C, kHottest_C, NumberText(*flags.temperature_C)));
  }
  if (flags.irradiance_W_m2 &&
      !(std::isfinite(*flags.irradiance_W_m2) && *flags.irradiance_W_m2 >= 0)) {
    return Fail(fmt::format("--irradiance-Wm2: expected at least 0 W/m2, found {}",
                            NumberText(*flags.irradiance_W_m2)));
  }
  return {};
}

}  // namespace

Flag AddResumeFlag(Verb* verb, const std::string& unit, std::string* target) {
  return verb
      ->AddOption("--resume", target,
                  "a journal: every finished " + unit +
                      " is added to it, and none that stands in it is done again; begun where "
                      "there is none")
      .Writes();
}

Flag AddBirdsFlag(Verb* verb, Birds* target) {
  return AddEnumFlag(verb, "--birds",
                     "a bird is a complete device, or a place in the hard parameters (Rs, n, "
                     "effects), where Iph, Is and Rsh are solved for",
                     target)
      .Group("Search");
}

Flag AddListFlag(Verb* verb, const std::string& flag, const std::string& doc,
                 std::vector<std::string>* target) {
  return verb->AddOption(flag, target, doc).OneEach().Type("TEXT ...");
}

Expected<std::pair<std::string, std::pair<double, double>>> ParseRange(const std::string& flag,
                                                                       const std::string& text) {
  constexpr char kExample[] = "PARAMETER=LOWER:UPPER such as Rs=0:0.5";
  const std::vector<std::string> sides = Split(text, '=');
  if (sides.size() != 2 || sides[0].empty()) return Misread(flag, kExample, text);
  const std::vector<std::string> ends = Split(sides[1], ':');
  if (ends.size() != 2) return Misread(flag, kExample, text);
  const std::optional<double> lower = ParseNumber(ends[0]);
  const std::optional<double> upper = ParseNumber(ends[1]);
  if (!lower || !upper) return Misread(flag, kExample, text);
  return std::pair(sides[0], std::pair(*lower, *upper));
}

Expected<std::pair<std::string, double>> ParseAssignment(const std::string& flag,
                                                         const std::string& text) {
  const std::vector<std::string> sides = Split(text, '=');
  const std::optional<double> value = sides.size() == 2 ? ParseNumber(sides[1]) : std::nullopt;
  if (!value || sides[0].empty()) return Misread(flag, "PARAMETER=VALUE such as n2=2", text);
  return std::pair(sides[0], *value);
}

Flag AddWithFlag(Verb* verb, const std::string& group, std::vector<std::string>* target) {
  return AddListFlag(
             verb, "--with",
             "an effect beside the diodes, as diagnose --explain names it: alone, with what "
             "the shape of the curve suggests free; or with parameters held (d=0.3) or "
             "within a range (d=0:0.5); once for each",
             target)
      .Type("EFFECT[:P=VALUE|LOW:HIGH,...]")
      .Group(group);
}

Expected<std::vector<EffectUse>> ParseWith(const std::vector<std::string>& texts) {
  std::vector<EffectUse> uses;
  for (const std::string& text : texts) {
    const std::size_t colon = text.find(':');
    EffectUse use;
    use.effect = FindEffect(text.substr(0, colon));
    if (use.effect == nullptr) {
      return Fail("--with: there is no effect '" + text.substr(0, colon) +
                  "'; lyrefit diagnose --explain lists them");
    }
    for (std::size_t at = colon; at != std::string::npos;) {
      const std::size_t next = text.find(',', at + 1);
      const std::string item = text.substr(at + 1, next - at - 1);
      if (item.find(':') != std::string::npos) {
        const auto range = ParseRange("--with", item);
        if (!range) return tl::unexpected(range.error());
        use.ranges[range->first] = range->second;
      } else {
        const auto assignment = ParseAssignment("--with", item);
        if (!assignment) return tl::unexpected(assignment.error());
        use.ranges[assignment->first] = {assignment->second, assignment->second};
      }
      at = next;
    }
    uses.push_back(std::move(use));
  }
  return uses;
}

Expected<std::vector<double>> ParseSteps(const std::string& flag, const std::string& text) {
  constexpr char kExample[] = "FROM:TO:COUNT in volt such as 0:0.6:50";
  const std::vector<std::string> parts = Split(text, ':');
  if (parts.size() != 3) return Misread(flag, kExample, text);
  const std::optional<double> from = ParseNumber(parts[0]);
  const std::optional<double> to = ParseNumber(parts[1]);
  const std::optional<double> count = ParseNumber(parts[2]);
  const bool sound = from && to && count && std::isfinite(*from) && std::isfinite(*to) &&
                     *count >= 2 && *count <= kMostSteps && *count == std::floor(*count);
  if (!sound) return Misread(flag, kExample, text);
  std::vector<double> steps(static_cast<std::size_t>(*count));
  for (std::size_t i = 0; i < steps.size(); ++i) {
    steps[i] = *from + (*to - *from) * static_cast<double>(i) / (*count - 1);
  }
  return steps;
}

void AddConditionFlags(Verb* verb, ConditionFlags* flags) {
  verb->AddOption("--cells", &flags->cells, "cells in series").Type("N").Group("Conditions");
  verb->AddOption("--temperature-C", &flags->temperature_C, "cell temperature in degrees Celsius")
      .Type("T")
      .Group("Conditions");
  verb->AddOption("--irradiance-Wm2", &flags->irradiance_W_m2, "irradiance in W/m2")
      .Type("G")
      .Group("Conditions");
  verb->AddSwitch("--as-is", &flags->as_is,
                  "take the readings as they are: what would be refused becomes a warning")
      .Group("Conditions");
}

Expected<void> ApplyConditionFlags(const ConditionFlags& flags, IvCurve* curve) {
  if (auto checked = CheckConditionFlags(flags); !checked) return checked;
  curve->as_is = flags.as_is;
  if (flags.cells) {
    curve->conditions.cells_in_series = *flags.cells;
    curve->cells_known = true;
    Forget(About::kCells, &curve->assumptions);
  }
  if (flags.temperature_C) {
    curve->conditions.cell_temperature_K = *flags.temperature_C + kZeroCelsius_K;
    curve->temperature_known = true;
    Forget(About::kTemperature, &curve->assumptions);
  }
  if (flags.irradiance_W_m2) {
    curve->conditions.irradiance_W_m2 = *flags.irradiance_W_m2;
    curve->irradiance_known = true;
    Forget(About::kIrradiance, &curve->assumptions);
  }
  return {};
}

Expected<void> ApplyConditionFlags(const ConditionFlags& flags, CurveSet* set) {
  for (IvCurve& curve : set->curves) {
    if (auto applied = ApplyConditionFlags(flags, &curve); !applied) return applied;
  }
  IvCurve common;  // carries the assumptions that hold for the whole set
  common.assumptions = set->assumptions;
  if (auto applied = ApplyConditionFlags(flags, &common); !applied) return applied;
  set->assumptions = common.assumptions;
  return {};
}

void AddColumnFlags(Verb* verb, ReadOptions* options, bool* list_columns) {
  verb->AddOption("--column", &options->column,
                  "which of several currents, or pairs of voltage and current, side by side")
      .Type("NAME|N")
      .Group("Reading");
  verb->AddOption("--voltage-column", &options->voltage_column,
                  "the column of the voltage, by name or number, where its name does not tell")
      .Type("NAME|N")
      .Group("Reading");
  verb->AddOption("--current-column", &options->current_column, "the same for the current")
      .Type("NAME|N")
      .Group("Reading");
  verb->AddOption("--voltage-unit", &options->voltage_unit,
                  "its unit, where the file names none: V, mV, uV or kV")
      .Type("UNIT")
      .Group("Reading");
  verb->AddOption("--current-unit", &options->current_unit,
                  "that of the current: A, mA, uA, nA, kA, mA/cm2, A/m2, ...")
      .Type("UNIT")
      .Group("Reading");
  verb->AddSwitch("--skip-missing", &options->skip_missing,
                  "leave out rows whose voltage or current is empty, NaN or an overflow code")
      .Group("Reading");
  verb->AddOption("--area-cm2", &options->area_cm2,
                  "area of the cell in cm2, which makes currents of current densities")
      .Between(1e-9, 1e9)
      .Type("A")
      .Group("Reading");
  verb->AddSwitch("--list-columns", list_columns,
                  "list the columns of the table and what each is read as, and stop")
      .Group("Reading");
}

int PrintColumns(const std::vector<std::string>& files, const ReadOptions& options) {
  std::string text;
  for (const std::string& file : files) {
    const auto columns = ListColumns(file, options);
    if (!columns) return Refuse(columns.error());
    if (files.size() > 1) text += file + ":\n";
    for (const ColumnNote& column : *columns) {
      text += fmt::format("{:>4}  {:<32}  {}\n", column.place, column.name, column.use);
    }
  }
  const auto written = WriteOutput("-", text);
  return written ? kExitFine : Refuse(written.error());
}

Expected<IvCurve> ReadCurveOrInput(const std::string& file, const ReadOptions& options) {
  if (file != "-") return ReadCurve(file, options);
  Expected<std::string> bytes = ReadFileBytes("/dev/stdin", options.largest_file_bytes);
  if (!bytes) return Fail(bytes.error().message, "standard input");
  return ReadCurveText(std::move(*bytes), "standard input", options);
}

void AddCurveFlags(Verb* verb, CurveFlags* flags) {
  verb->AddOption("CURVE", &flags->file,
                  "table (CSV, text, most instruments' files) or JSON, a folder, or - for standard "
                  "input")
      .Required()
      .ReadsCurves();
  AddReadingFlags(verb, flags);
}

void AddReadingFlags(Verb* verb, CurveFlags* flags) {
  verb->AddOption("--curve", &flags->index, "which curve of a file that holds several")
      .Type("INDEX")
      .Group("Reading");
  AddColumnFlags(verb, &flags->reading, &flags->list_columns);
  AddConditionFlags(verb, &flags->conditions);
}

Expected<IvCurve> ReadFlaggedCurve(const CurveFlags& flags) {
  ReadOptions reading = flags.reading;
  reading.curve = flags.index;
  Expected<IvCurve> curve = ReadCurveOrInput(flags.file, reading);
  if (!curve) return curve;
  if (auto applied = ApplyConditionFlags(flags.conditions, &*curve); !applied) {
    return tl::unexpected(applied.error());
  }
  return curve;
}

void AddFullJsonSwitch(Verb* verb, ReportFlags* flags) {
  verb->AddSwitch("--full-json", &flags->full_json,
                  fmt::format("repeat every reading of curves of more than {} in JSON files",
                              kMostJsonPoints))
      .Group("Output");
}

void AddReportFlags(Verb* verb, const std::string& what, const std::string& picture,
                    ReportFlags* flags) {
  verb->AddOption("--json", &flags->json_file,
                  "the " + what + " as JSON; - for standard output, alone")
      .Writes();
  verb->AddOption("--plot", &flags->plot_file, "the " + picture + " as a picture, .svg or .png")
      .Draws();
  verb->AddSwitch("--brief", &flags->brief, "one line instead of the whole report").Group("Output");
  verb->AddQuietSwitch();
}

}  // namespace lyrefit
