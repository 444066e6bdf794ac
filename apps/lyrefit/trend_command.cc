#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flags.h"
#include "interrupt.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/date_time.h"
#include "lyrefit/read/read_module.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json.h"
#include "lyrefit/report/page.h"
#include "lyrefit/report/plots.h"
#include "lyrefit/trend/read_trend.h"
#include "lyrefit/trend/trend.h"
#include "lyrefit/trend/trend_documents.h"
#include "verbs.h"

namespace lyrefit {
namespace {

constexpr char kTrendFooter[] =
    "Examples:\n"
    "  lyrefit trend module7.csv --html trend.html\n"
    "  lyrefit trend sweeps_of_2024 sweeps_of_2025 --cells 60 --json trend.json\n"
    "  lyrefit trend today.csv --append module7.state && lyrefit trend module7.state\n"
    "  lyrefit trend --operating inverter.csv --module module.json\n"
    "\n"
    "All sweeps are of one device, each with its time (date, timestamp), light and temperature, "
    "in\n"
    "any shape that batch reads.\n"
    "\n"
    "Exit codes: 0 fine, 1 bad input or options, 130 stopped by Ctrl-C (the sweeps read so far "
    "are\n"
    "judged, if that takes no second, or appended).";

struct TrendRequest {
  std::vector<std::string> inputs;
  BatchReadOptions reading;
  ConditionOptions conditions;
  TrendOptions options;
  std::string module_file;
  std::string state_file;
  bool operating = false;
  ReportFlags output;
};

void DeclareTrend(VerbLine* verb, TrendRequest* request) {
  verb->AddOption("SWEEPS", &request->inputs,
                  "sweeps of one device over time: one a row (JSON Lines, CSV), a long table, a "
                  "folder tree, a set; or the state that --append keeps")
      .ReadsCurves();
  verb->AddOption("--module", &request->module_file,
                  "the law of the device: a file of pvlib, PVsyst or SAM; else that of its sweeps")
      .Reads();
  verb->AddSwitch("--operating", &request->operating,
                  "the files are tables of operating points: time, irradiance, temperature, vmp, "
                  "imp; needs --module");
  verb->AddOption("--append", &request->state_file,
                  "append the sweeps to the state in this file and say what they show, without a "
                  "report")
      .Writes();
  AddTableFlags(verb, kTrendOptionTable, &request->options);
  AddTableFlags(verb, kReadOptionTable, &request->reading.reading);
  AddTableFlags(verb, kConditionOptionTable, &request->conditions);
  AddReportFlags(verb, "trend", "days as a table, a row each", "quantities over time",
                 &request->output);
}

Expected<TrendReadOptions> ReadingOf(const TrendRequest& request) {
  TrendReadOptions reading;
  reading.reading = request.reading;
  if (!request.module_file.empty()) {
    TRY(const NamedParameters module, ReadModuleParameters(request.module_file));
    const TrendSource source =
        request.operating ? TrendSource::kOperatingPoints : TrendSource::kSweeps;
    TRY(reading.law, SeriesOfModule(module, source, request.conditions.bypass_diodes.value_or(0)));
  }
  reading.prepare = [conditions = request.conditions](IvCurve* curve) {
    return ApplyConditionFlags(conditions, curve);
  };
  return reading;
}

Expected<TrendSeries> ReadMeasurements(const TrendRequest& request,
                                       const TrendReadOptions& reading) {
  if (request.operating) return ReadOperatingPoints(request.inputs, reading);
  return ReadTrend(request.inputs, reading, request.options, TerminalObserver());
}

SaidOfDevice SaidBy(const TrendRequest& request, const TrendReadOptions& reading) {
  return {request.conditions.cells, request.conditions.bypass_diodes, reading.law,
          request.operating ? TrendSource::kOperatingPoints : TrendSource::kSweeps};
}

Expected<TrendSeries> ReadSeries(const TrendRequest& request) {
  TRY(const TrendReadOptions reading, ReadingOf(request));
  const std::string& first = request.inputs.front();
  if (request.inputs.size() > 1 || !IsTrendState(first)) return ReadMeasurements(request, reading);
  TRY(TrendSeries series, ReadTrendState(first));
  SaidOfDevice said = SaidBy(request, reading);
  if (!request.operating) said.source.reset();
  TRY(CheckSaid(series, said, first));
  return series;
}

// What one measurement shows, in a line.
std::string RowText(const TrendRow& row) {
  std::string text = fmt::format("{}: ", DateTimeText(row.time_s));
  if (!row.reason.empty()) return text + row.reason + "\n";
  text += fmt::format("{:.4g} W", row.power_W());
  if (std::isfinite(row.parameters[kTrendSeries])) {
    text += fmt::format(", light {:.4g} %, Rs {:.4g} ohm, shunt {:.3g} S",
                        100 * std::exp(row.parameters[kTrendLight]), row.parameters[kTrendSeries],
                        row.parameters[kTrendShunt]);
  }
  if (row.lost_substrings > 0) {
    text += fmt::format(", {} of the substrings without voltage", row.lost_substrings);
  }
  return text + "\n";
}

// How many measurements are left out, and the reason of the first.
std::string LeftOutText(const std::vector<TrendRow>& rows) {
  const auto left_out = [](const TrendRow& row) { return !row.reason.empty(); };
  const auto first = std::find_if(rows.begin(), rows.end(), left_out);
  if (first == rows.end()) return {};
  return fmt::format("{} of them left out, the first: {}\n",
                     std::count_if(first, rows.end(), left_out), first->reason);
}

Expected<int> AppendToState(VerbLine& verb, const TrendRequest& request) {
  TrendSeries series;
  TRY(auto state, ReadTrendStateHead(request.state_file));
  if (state) {
    TRY(TrendReadOptions reading, ReadingOf(request));
    TRY(CheckSaid(*state, SaidBy(request, reading), request.state_file));
    reading.law = std::move(state);
    TRY(series, ReadMeasurements(request, reading));
  } else {
    TRY(series, ReadSeries(request));
  }
  TRY(const std::int64_t written, AppendTrendState(request.state_file, series));
  std::string text;
  constexpr std::size_t kShown = 10;
  if (series.rows.size() <= kShown) {
    for (const TrendRow& row : series.rows) text += RowText(row);
  }
  text += fmt::format("{} of {} appended to {}\n", written, series.rows.size(), request.state_file);
  if (series.rows.size() > kShown) text += LeftOutText(series.rows);
  TRY(WriteText(verb, [&] { return text; }));
  return series.interrupted ? kExitInterrupted : kExitFine;
}

Expected<int> RunTrend(VerbLine& verb, TrendRequest& request) {
  if (request.inputs.empty()) return Fail("SWEEPS is required: the measurements of a device");
  TRY(verb.CheckFiles());
  const InterruptGuard guard;
  if (!request.state_file.empty()) {
    const ReportFlags& files = request.output;
    if (!(files.json_file + files.csv_file + files.plot_file + files.html_file).empty()) {
      return Fail("--append writes no report: ask the state for it, lyrefit trend " +
                  request.state_file);
    }
    return AppendToState(verb, request);
  }
  TRY(const TrendSeries series, ReadSeries(request));
  // No part of a trend is worth keeping.
  series.interrupted ? EndWithinASecond() : EndOnSignals();
  TRY(const TrendReport report, FindTrend(series, request.options, TerminalObserver()));
  const ReportFlags& output = request.output;
  TRY(WriteWanted(output.json_file, [&] { return TrendJson(report); }));
  TRY(WriteWanted(output.csv_file, [&] { return TrendCsv(report); }));
  TRY(DrawWanted(output.plot_file,
                 [&](const std::string& file) { return PlotTrend(report, file, output.marks()); }));
  TRY(WriteWanted(output.html_file,
                  [&] { return DrawPage(TrendDocument(report), TrendJson(report)); }));
  TRY(WriteText(verb, [&] { return output.brief ? BriefTrend(report) : TrendText(report); }));
  return report.interrupted ? kExitInterrupted : kExitFine;
}

}  // namespace

const Verb kTrendVerb = {"trend", "Say what changed in a device over time", kTrendFooter,
                         "the trend as text, --json, --csv, --plot and --html",
                         Declare<TrendRequest, DeclareTrend, RunTrend>};

}  // namespace lyrefit
