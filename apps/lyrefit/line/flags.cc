#include "flags.h"

#include <fmt/format.h>

#include "lyrefit/base/file.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/inspect/inspect.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/read_curve_set.h"
#include "lyrefit/report/plots.h"

namespace lyrefit {
namespace {

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

}  // namespace

Flag AddResumeFlag(VerbLine* verb, const std::string& unit, std::string* target) {
  return verb
      ->AddOption("--resume", target,
                  "a journal: every finished " + unit +
                      " is added to it, and none that stands in it is done again; begun where "
                      "there is none")
      .Writes();
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

namespace {

// Converts the option name at the start of a library error to the flag's name.
Expected<void> AsFlags(Expected<void> applied) {
  if (!applied) applied.error().message = "--" + applied.error().message;
  return applied;
}

}  // namespace

Expected<void> ApplyConditionFlags(const ConditionOptions& flags, IvCurve* curve) {
  return AsFlags(ApplyConditions(flags, curve));
}

Expected<void> ApplyConditionFlags(const ConditionOptions& flags, CurveSet* set) {
  return AsFlags(ApplyConditions(flags, set));
}

void AddColumnFlags(VerbLine* verb, ReadOptions* options, bool* list_columns) {
  AddTableFlags(verb, kReadOptionTable, options);
  verb->AddSwitch("--list-columns", list_columns,
                  "say what the file holds and what each column is read as, as lyrefit inspect "
                  "does, and stop")
      .Group("Reading");
}

Expected<int> PrintInspections(const std::vector<std::string>& files, const ReadOptions& options) {
  std::string text;
  for (const std::string& file : files) {
    TRY(const Inspection found, Inspect(file, options));
    text += (text.empty() ? "" : "\n") + InspectionText(found);
  }
  TRY(WriteOutput("-", text));
  return kExitFine;
}

Expected<IvCurve> ReadCurveOrInput(const std::string& file, const ReadOptions& options) {
  if (file != "-") return ReadCurve(file, options);
  Expected<std::string> bytes = ReadFileBytes("/dev/stdin", options.largest_file_bytes);
  if (!bytes) return Fail(bytes.error().message, "standard input");
  return ReadCurveText(std::move(*bytes), "standard input", options);
}

Expected<CurveSet> ReadMeasurementOrInput(const std::string& file, const ReadOptions& options) {
  if (file != "-") return ReadMeasurement(file, options);
  TRY(IvCurve curve, ReadCurveOrInput(file, options));
  return SetOfOne(std::move(curve));
}

void AddCurveFlags(VerbLine* verb, CurveFlags* flags) {
  verb->AddOption("CURVE", &flags->file,
                  "table (CSV, text, most instruments' files) or JSON, a folder, or - for standard "
                  "input")
      .Required()
      .ReadsCurves();
  AddReadingFlags(verb, flags);
}

void AddReadingFlags(VerbLine* verb, CurveFlags* flags) {
  verb->AddOption("--curve", &flags->index, "which curve of a file that holds several")
      .Type("INDEX")
      .Group("Reading");
  AddColumnFlags(verb, &flags->reading, &flags->list_columns);
  AddTableFlags(verb, kConditionOptionTable, &flags->conditions);
}

Expected<IvCurve> ReadFlaggedCurve(const CurveFlags& flags) {
  ReadOptions reading = flags.reading;
  reading.curve = flags.index;
  TRY(IvCurve curve, ReadCurveOrInput(flags.file, reading));
  TRY(ApplyConditionFlags(flags.conditions, &curve));
  return curve;
}

void AddFullSwitches(VerbLine* verb, ReportFlags* flags) {
  verb->AddSwitch("--full-json", &flags->full_json,
                  fmt::format("repeat every reading of curves of more than {} in JSON files",
                              kMostJsonPoints))
      .Group("Output");
  verb->AddSwitch("--full-plot", &flags->full_plot,
                  "draw every reading, also of curves of so many that some look like all")
      .Group("Output");
}

void AddCsvFlag(VerbLine* verb, const std::string& table, ReportFlags* flags) {
  verb->AddOption("--csv", &flags->csv_file, table + "; - for standard output, alone").Writes();
}

void AddHtmlFlag(VerbLine* verb, const std::string& what, ReportFlags* flags) {
  verb->AddOption("--html", &flags->html_file,
                  "the " + what + " as a page to send, with pictures and data in one file")
      .Writes();
}

void AddReportFlags(VerbLine* verb, const std::string& what, const std::string& table,
                    const std::string& picture, ReportFlags* flags) {
  verb->AddOption("--json", &flags->json_file,
                  "the " + what + " as JSON; - for standard output, alone")
      .Writes();
  if (!table.empty()) AddCsvFlag(verb, table, flags);
  verb->AddOption("--plot", &flags->plot_file,
                  "the " + picture + " as a picture, .svg, .png or .pdf")
      .Draws();
  AddHtmlFlag(verb, what, flags);
  verb->AddSwitch("--brief", &flags->brief, "one line instead of the whole report").Group("Output");
  verb->AddQuietSwitch();
}

}  // namespace lyrefit
