#include <fmt/format.h>

#include <filesystem>

#include "bounds_flag.h"
#include "fit_kinds.h"
#include "flags.h"
#include "interrupt.h"
#include "lyrefit/base/try.h"
#include "lyrefit/estimate/fit/fit_files.h"
#include "lyrefit/read/read_curve_set.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json.h"
#include "lyrefit/report/page.h"
#include "lyrefit/report/plots.h"
#include "model_flag.h"
#include "output.h"
#include "verbs.h"

namespace lyrefit {
namespace {

constexpr char kFitFooter[] =
    "Examples:\n"
    "  lyrefit fit data/rtc_france --model sd\n"
    "  lyrefit fit module.csv --cells 36 --temperature-C 45 --model auto --plot module.svg\n"
    "  lyrefit fit cell.csv --model dd --fix n2=2 --bound Rs=0:0.1 --json -\n"
    "  lyrefit fit module.csv --cells 60 --temperature-C 45 --with shading:w=0.333\n"
    "  lyrefit fit roof/*.csv --cells 60 --temperature-C 45 --csv table.csv\n"
    "  lyrefit fit folder_of_curves --family desoto --pvlib module.json --plot module.svg\n"
    "  lyrefit fit sweeps.csv --family auto --irradiance-accuracy 2% --leave-out 17,18\n"
    "  lyrefit fit sweeps.csv --family auto --fit-curves 30 --against module.json\n"
    "  lyrefit fit white.csv red.csv blue.csv --junctions 2 --light red=1:1.1\n"
    "\n"
    "Exit codes: 0 fine; 1 bad input or options, of several files some could not be fitted; 2 a "
    "fit\n"
    "is not usable.";

// Error if no single curve could be read: `found`, or that the file has many curves.
Error WhyNotOneCurve(const CurveFlags& flags, const Error& found) {
  if (flags.index || !HoldsCurveSet(flags.file, flags.reading)) return found;
  const Expected<CurveSet> set = ReadCurveSet(flags.file, flags.reading);
  if (!set || set->curves.size() < 2) return found;
  std::error_code error;
  const bool folder = std::filesystem::is_directory(flags.file, error);
  ReadOptions first = flags.reading;
  first.column = "1";
  const char* how = "choose one with --curve INDEX";
  if (ReadCurve(flags.file, first)) how = "choose one with --column NAME|N (see --list-columns)";
  if (folder) how = "give one of its files";
  return {fmt::format("this is a set of {} curves: {}, or fit all of them with --family "
                      "desoto|pvsyst|free|auto if they are of one device, or each by itself with "
                      "lyrefit batch",
                      set->curves.size(), how),
          flags.file};
}

// The arguments and the kinds of fit whose flags were declared.
struct FitRequest {
  FitArguments fit;
  std::vector<std::unique_ptr<FitKind>> kinds = FitKinds();
};

void AddModelFlags(VerbLine* verb, FitArguments* fit) {
  AddModelFlag(verb, &fit->options.model, &fit->auto_model);
  AddNamedFlags(verb, kFitOptionTable, {"objective", "constants"}, &fit->options);
  AddBoundsFlag(verb, "Model", &fit->bounds);
  AddNamedFlags(verb, kFitOptionTable, {"bound", "fix"}, &fit->options);
  AddTableFlags(verb, kFitOptionTable, &fit->options, "Model");
}

void DeclareFit(VerbLine* verb, FitRequest* request) {
  FitArguments* const fit = &request->fit;
  verb->AddOption("CURVE", &fit->files,
                  "table (CSV, text, most instruments' files) or JSON, a folder, or - for standard "
                  "input; several: a line each")
      .Required()
      .ReadsCurves();
  AddReadingFlags(verb, &fit->curve);
  AddModelFlags(verb, fit);
  AddTableFlags(verb, kFitOptionTable, &fit->options, "Search");
  AddTableFlags(verb, kSearchOptionTable, &fit->options.search);
  AddTableFlags(verb, kFitOptionTable, &fit->options);
  for (const auto& kind : request->kinds) kind->Declare(verb, &fit->output);
  AddReportFlags(verb, "report", "", "fit", &fit->output);
  AddFullSwitches(verb, &fit->output);
}

// A curve and the options of its fit.
struct FitJob {
  IvCurve curve;
  FitOptions options;
};

Expected<FitJob> ReadJob(const FitArguments& fit, const std::string& file) {
  FitOptions options = fit.options;
  TRY(options.bounds, FlaggedBounds(fit.bounds, file));
  for (const auto& [name, range] : fit.options.bounds.overrides) {
    options.bounds.overrides[name] = range;
  }
  CurveFlags flags = fit.curve;
  flags.file = file;
  Expected<IvCurve> curve = ReadFlaggedCurve(flags);
  if (!curve) return tl::unexpected(WhyNotOneCurve(flags, curve.error()));
  return FitJob{std::move(*curve), std::move(options)};
}

Expected<FitReport> Run(const FitArguments& fit, const FitJob& job, const Observer& observer) {
  return FitOneCurve(job.curve, job.options, fit.auto_model, observer);
}

Expected<void> Write(const VerbLine& verb, const FitArguments& fit,
                     const std::vector<FittedFile>& fits) {
  const ReportFlags& output = fit.output;
  const bool one = fit.files.size() == 1;
  TRY(WriteWanted(output.json_file, [&] {
    return one ? JsonReport(*fits.front().report, output.points())
               : FitsJson(fits, output.points());
  }));
  TRY(WriteWanted(output.csv_file, [&] { return FitsCsv(fits); }));
  TRY(DrawWanted(output.plot_file, [&](const std::string& file) {
    return PlotFit(*fits.front().report, file, output.marks());
  }));
  TRY(WriteWanted(output.html_file, [&] {
    return one ? DrawPage(FitDocument(*fits.front().report),
                          JsonReport(*fits.front().report, JsonPoints::kAll))
               : DrawPage(FitsDocument(fits), FitsJson(fits, JsonPoints::kAll));
  }));
  return WriteText(verb, [&] {
    std::string text;
    for (const FittedFile& file : fits) {
      if (!file.report) continue;
      text += !one || output.brief ? BriefReport(*file.report)
              : verb.Whole()       ? FullReport(*file.report)
                                   : ShortReport(*file.report);
    }
    return text;
  });
}

Expected<int> RunOne(const VerbLine& verb, const FitArguments& fit) {
  TRY(const FitJob job, ReadJob(fit, fit.files.front()));
  const InterruptGuard guard;
  TRY(FitReport report, Run(fit, job, TerminalObserver()));
  const int exit_code = report.interrupted ? kExitInterrupted
                        : report.usable    ? kExitFine
                                           : kExitNotUsable;
  TRY(Write(verb, fit, {{fit.files.front(), std::move(report)}}));
  return exit_code;
}

// A failed file does not stop the others.
Expected<int> RunMany(const VerbLine& verb, const FitArguments& fit) {
  for (const char* flag : {"--plot", "--curve"}) {
    if (verb.Given(flag)) return Fail(std::string(flag) + " is for one CURVE");
  }
  const InterruptGuard guard;
  const std::vector<FittedFile> fits =
      FitFiles(fit.files, fit.options.threads, TerminalObserver({"fit"}),
               [&fit](int i, const Observer& observer) -> Expected<FitReport> {
                 TRY(FitJob job, ReadJob(fit, fit.files[i]));
                 job.options.threads = 1;
                 return Run(fit, job, observer);
               });
  int exit_code = kExitFine;
  bool interrupted = fits.size() < fit.files.size();
  for (const FittedFile& file : fits) {
    if (!file.report) {
      exit_code = Refuse(file.report.error());
      continue;
    }
    interrupted = interrupted || file.report->interrupted;
    if (!file.report->usable && exit_code == kExitFine) {
      exit_code = kExitNotUsable;
    }
  }
  TRY(Write(verb, fit, fits));
  return interrupted ? kExitInterrupted : exit_code;
}

Expected<int> RunFit(VerbLine& verb, FitRequest& request) {
  FitArguments& fit = request.fit;
  if (fit.curve.list_columns) return PrintInspections(fit.files, fit.curve.reading);
  for (auto kind = request.kinds.rbegin(); kind != request.kinds.rend(); ++kind) {
    TRY(const bool asked, (*kind)->IsAsked(verb));
    if (asked) return (*kind)->Run(verb, &fit);
  }
  TRY(SettleFitFlags(verb, &fit));
  TRY(verb.CheckFiles());
  return fit.files.size() == 1 ? RunOne(verb, fit) : RunMany(verb, fit);
}

}  // namespace

Expected<void> SettleFitFlags(const VerbLine& verb, FitArguments* fit) {
  FitOptions& options = fit->options;
  if (options.with.empty()) return {};
  options.force_effects = verb.Forced();
  const SearchOptions usual = FitOptions::SearchBesideShapes();
  if (!verb.Given("--population")) options.search.population = usual.population;
  if (!verb.Given("--iterations")) options.search.iterations = usual.iterations;
  if (!fit->auto_model) return {};
  return Fail("--model auto chooses among diodes alone: say which --model stands beside --with");
}

const Verb kFitVerb = {"fit",
                       "Fit diode-model parameters to a measured I-V curve",
                       kFitFooter,
                       "the report as text, --json, --csv, --plot and --html",
                       Declare<FitRequest, DeclareFit, RunFit>,
                       VerbKind::kPromised};

}  // namespace lyrefit
