#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>

#include "diagnose_request.h"
#include "effect_text.h"
#include "interrupt.h"
#include "lyrefit/base/try.h"
#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/read/read_curve_set.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json.h"
#include "lyrefit/report/page.h"
#include "lyrefit/report/plots.h"
#include "verbs.h"

namespace lyrefit {
namespace {

constexpr char kDiagnoseFooter[] =
    "Examples:\n"
    "  lyrefit diagnose sweep.csv --cells 60 --temperature-C 45 --html diagnosis.html\n"
    "  lyrefit diagnose folder_of_curves --base dd --json diagnosis.json --extend model.json\n"
    "  lyrefit diagnose roof/*.csv --effects nonohmic_shunt,clip --answers answers.json\n"
    "  lyrefit diagnose today.csv --reference last_year/*.csv\n"
    "  lyrefit diagnose folder_of_sweeps --module\n"
    "  lyrefit diagnose --explain nonohmic_shunt\n"
    "\n"
    "A measurement is one sweep, up and down sweeps, a lit and a dark curve, or curves over\n"
    "irradiance and temperature, in one file or folder. Of several files every one has a line.\n"
    "\n"
    "Exit codes: 0 fine, found or not; 1 bad input or options, of several files some could not be\n"
    "diagnosed; 2 a fit is not usable.";

// Name of a file in the answers: "data/roof/sweep.csv" is "sweep".
std::string Stem(const std::string& file) {
  const std::filesystem::path path = std::filesystem::path(file).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).stem().string();
}

// The measurements of a run: names of their files in the answers, and their diagnoses.
struct Diagnoses {
  std::vector<std::string> names;
  std::vector<Diagnosis> found;
  int exit_code = kExitFine;
  bool interrupted = false;
};

void DeclareDiagnose(VerbLine* verb, DiagnoseRequest* request) {
  verb->AddOption("CURVE", &request->files,
                  "files or folders, a measurement each; - for standard input; beside them the "
                  "sheet of their module, JSON")
      .ReadsCurves();
  verb->AddSwitch("--together", &request->together,
                  "all files are one measurement: lit and dark, up and down, a family");
  request->reading.keep_limited = true;  // a limit of the instrument is a finding
  AddColumnFlags(verb, &request->reading, &request->list_columns);
  AddTableFlags(verb, kConditionOptionTable, &request->conditions);
  AddTableFlags(verb, kDiagnoseOptionTable, &request->options);
  AddReferenceFlags(verb, request);
  verb->AddSwitch("--list", &request->list, "list the effects that are known").Group("Catalogue");
  verb->AddOption("--explain", &request->explain, "say all about one effect")
      .Type("EFFECT")
      .OneOf(EffectIds())
      .Group("Catalogue");
  AddReportFlags(verb, "diagnosis", "the causes as a table, a row each", "diagnosis",
                 &request->output);
  AddFullSwitches(verb, &request->output);
  const auto add_file = [verb](const char* flag, std::string* file, const char* doc) {
    verb->AddOption(flag, file, std::string(doc) + "; - for standard output, alone").Writes();
  };
  add_file("--extend", &request->extend_file,
           "the model with its causes, fitted, as the JSON of fit");
  add_file("--answers", &request->answers_file,
           "the bare answers by file as JSON, each cause with what it could be too");
}

// Answers are identified by their names, so these must differ.
Expected<void> CheckNames(const DiagnoseRequest& request) {
  if (request.answers_file.empty()) return {};
  std::set<std::string> names;
  for (const std::string& file : request.files) {
    if (!names.insert(Stem(file)).second) {
      return Fail(fmt::format("--answers: two files are named '{}'", Stem(file)), file);
    }
  }
  return {};
}

Expected<void> CheckRequest(const VerbLine& verb, const DiagnoseRequest& request) {
  if (request.files.empty()) return Fail("CURVE is required: a file or folder to diagnose");
  if (request.Several()) {
    for (const char* flag : {"--plot", "--html", "--extend"}) {
      if (verb.Given(flag)) return Fail(std::string(flag) + " is for one CURVE");
    }
  }
  TRY(CheckEffects("--effects", request.options.effects));
  TRY(CheckNames(request));
  TRY(CheckReferenceFlags(request));
  return verb.CheckFiles();
}

Expected<CurveSet> Read(const DiagnoseRequest& request, const std::vector<std::string>& files) {
  return files.size() > 1 ? ReadMeasurement(files, request.reading)
                          : ReadMeasurementOrInput(files.front(), request.reading);
}

Expected<CurveSet> ReadFlagged(const DiagnoseRequest& request,
                               const std::vector<std::string>& files) {
  TRY(CurveSet set, Read(request, files));
  if (request.conditions.irradiance_W_m2 && set.curves.size() > 1) {
    return Fail(fmt::format("--irradiance-Wm2 is for one curve, this measurement has {}",
                            set.curves.size()),
                files.front());
  }
  TRY(ApplyConditionFlags(request.conditions, &set));
  for (IvCurve& curve : set.curves) FillLayout(request.layout, &curve);
  return set;
}

Expected<Diagnosis> DiagnoseSet(const DiagnoseRequest& request, const CurveSet& set,
                                const std::string& file) {
  Expected<Diagnosis> diagnosis = Diagnose(set, request.options, TerminalObserver());
  if (!diagnosis && diagnosis.error().file.empty()) diagnosis.error().file = file;
  return diagnosis;
}

// A failed measurement does not stop the others. Sets `guard` at the first measurement that was
// read.
Diagnoses DiagnoseAll(const DiagnoseRequest& request, std::optional<InterruptGuard>* guard) {
  Diagnoses all;
  std::vector<std::vector<std::string>> measurements;
  if (request.together) measurements = {request.files};
  for (const std::string& file : request.files) {
    if (!request.together) measurements.push_back({file});
  }
  for (const std::vector<std::string>& files : measurements) {
    const Expected<CurveSet> set = ReadFlagged(request, files);
    if (!*guard) guard->emplace();
    Expected<Diagnosis> diagnosis = set ? DiagnoseSet(request, *set, files.front())
                                        : Expected<Diagnosis>(tl::unexpected(set.error()));
    if (!diagnosis) {
      all.exit_code = Refuse(diagnosis.error());
      all.interrupted = Interrupted();
      if (all.interrupted) break;
      continue;
    }
    if (!diagnosis->extended.usable && all.exit_code == kExitFine) {
      all.exit_code = kExitNotUsable;
    }
    all.names.push_back(Stem(files.front()));
    all.found.push_back(std::move(*diagnosis));
    all.interrupted = all.found.back().interrupted;
    if (all.interrupted) break;
  }
  return all;
}

Expected<void> Write(const VerbLine& verb, const DiagnoseRequest& request, const Diagnoses& all) {
  if (all.found.empty()) return {};
  const Diagnosis& first = all.found.front();
  const ReportFlags& output = request.output;
  TRY(WriteWanted(output.json_file, [&] {
    return request.Several() ? DiagnosisJson(all.found) : DiagnosisJson(first);
  }));
  TRY(WriteWanted(output.csv_file, [&] { return CausesCsv(all.names, all.found); }));
  TRY(WriteWanted(request.extend_file,
                  [&] { return JsonReport(first.extended, output.points()); }));
  TRY(WriteWanted(request.answers_file, [&] { return AnswersJson(all.names, all.found); }));
  TRY(DrawWanted(output.plot_file, [&](const std::string& file) {
    return PlotDiagnosis(first, file, output.marks());
  }));
  TRY(WriteWanted(output.html_file,
                  [&] { return DrawPage(DiagnosisDocument(first), DiagnosisJson(first)); }));
  return WriteText(verb, [&] {
    std::string text;
    for (const Diagnosis& diagnosis : all.found) {
      const bool brief = output.brief || request.Several();
      text += brief ? BriefDiagnosis(diagnosis) : DiagnosisText(diagnosis, LengthWanted(verb));
    }
    return text;
  });
}

// Takes the sheet of the module out of the files. Beside it and one file --module does not ask for
// outliers among sweeps.
Expected<void> TakeSheet(DiagnoseRequest* request) {
  std::vector<std::string>& files = request->files;
  const auto sheet = std::find_if(files.begin(), files.end(), IsModuleSheet);
  if (sheet == files.end()) return {};
  TRY(request->layout, ReadDeviceLayout(*sheet));
  files.erase(sheet);
  std::error_code error;
  if (files.size() == 1 && !std::filesystem::is_directory(files.front(), error)) {
    request->module = false;
  }
  return {};
}

Expected<int> RunDiagnose(VerbLine& verb, DiagnoseRequest& request) {
  if (request.list || !request.explain.empty()) {
    TRY(const std::string text,
        request.list ? Expected<std::string>(EffectList()) : ExplainEffect(request.explain));
    TRY(WriteOutput("-", text));
    return kExitFine;
  }
  request.options.extend = !request.extend_file.empty();
  request.reference.threads = request.options.threads;
  TRY(TakeSheet(&request));
  TRY(CheckRequest(verb, request));
  if (request.module) return RunModule(verb, request);
  if (!request.reference_files.empty()) return RunReferences(verb, request);
  std::optional<InterruptGuard> guard;
  const Diagnoses all = DiagnoseAll(request, &guard);
  TRY(Write(verb, request, all));
  return all.interrupted ? kExitInterrupted : all.exit_code;
}

}  // namespace

const Verb kDiagnoseVerb = {"diagnose",
                            "Say what a diode model gets wrong in a measurement, and why",
                            kDiagnoseFooter,
                            "the diagnosis as text, --json, --csv, --plot and --html",
                            Declare<DiagnoseRequest, DeclareDiagnose, RunDiagnose>,
                            VerbKind::kPromised};

}  // namespace lyrefit
