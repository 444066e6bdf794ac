#include <string>
#include <vector>

#include "effect_text.h"
#include "flags.h"
#include "interrupt.h"
#include "lyrefit/base/try.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json.h"
#include "lyrefit/report/page.h"
#include "lyrefit/report/plots.h"
#include "lyrefit/translate/translate.h"
#include "lyrefit/translate/translation_documents.h"
#include "progress_text.h"
#include "translation_flags.h"
#include "verbs.h"

namespace lyrefit {
namespace {

constexpr char kTranslateFooter[] =
    "Examples:\n"
    "  lyrefit translate string07.csv --to 1000,25 --cells 720 --irradiance-Wm2 846\n"
    "      --temperature-C 47 --alpha 0.05% --beta -0.27% --plot string07.svg\n"
    "  lyrefit translate string07.csv --rated-W 300 --modules 12 --tolerance -0,+3\n"
    "      --irradiance-from reference-cell --temperature-from back\n"
    "  lyrefit translate bright.csv --with-curve dim.csv --to 600,40 --procedures iec3\n"
    "  lyrefit translate module.csv --coefficients sheet.json --lead-resistance 0.12 --json -\n"
    "\n"
    "What nobody states of the coefficients is that of the technology, or is read off the curve;\n"
    "the report lists it. Without --rated-W nothing is passed or failed.\n"
    "\n"
    "Exit codes: 0 fine, passed or not; 1 bad input or options; 2 no procedure could be computed.";

struct TranslateRequest {
  CurveFlags curve;
  TranslateOptions options;
  std::vector<std::string> further_files;
  std::string coefficients_file;
  std::string module_file;
  ReportFlags output;
};

void DeclareTranslate(VerbLine* verb, TranslateRequest* request) {
  TranslateOptions& options = request->options;
  AddCurveFlags(verb, &request->curve);
  AddTableFlags(verb, kTranslateOptionTable, &options);
  verb->AddOption("--with-curve", &request->further_files,
                  "another curve of the same device under other conditions, for procedure 3; once "
                  "for each of at most two")
      .OneEach()
      .ReadsCurves()
      .Group("Measurement");
  AddTranslationFlags(verb, "", &request->coefficients_file, &request->module_file, &options);
  for (const auto& row : TranslateDiagnosisRows()) {
    AddRowFlag(verb, row, "Diagnosis", &options.diagnosis);
  }
  AddReportFlags(verb, "report", "the results as a table, a row a procedure",
                 "curve as measured and as translated", &request->output);
}

// Reads the further curves with the options of the first one; given conditions apply only to the
// first.
Expected<void> ReadFurther(const TranslateRequest& request, TranslateOptions* options) {
  constexpr std::size_t kMost = 2;
  if (request.further_files.size() > kMost) {
    return Fail("--with-curve: procedure 3 takes at most two further curves");
  }
  for (const std::string& file : request.further_files) {
    TRY(IvCurve curve, ReadCurveOrInput(file, request.curve.reading));
    ConditionOptions cells;
    cells.cells = request.curve.conditions.cells;
    TRY(ApplyConditionFlags(cells, &curve));
    options->further.push_back(std::move(curve));
  }
  return {};
}

Expected<int> RunTranslate(VerbLine& verb, TranslateRequest& request) {
  if (request.curve.list_columns)
    return PrintInspections({request.curve.file}, request.curve.reading);
  TRY(verb.CheckFiles());
  TranslateOptions& options = request.options;
  TRY(CheckEffects("--effects", options.diagnosis.effects));
  ShareSeedAndThreads(&options);
  if (!request.coefficients_file.empty()) {
    TRY(ReadCoefficients(request.coefficients_file, &options.coefficients));
  }
  if (!request.module_file.empty()) TRY(ReadModule(request.module_file, &options));
  TRY(const IvCurve curve, ReadFlaggedCurve(request.curve));
  TRY(ReadFurther(request, &options));
  const InterruptGuard guard;
  TRY(const TranslationReport report, TranslateCurve(curve, options, TerminalObserver()));
  const ReportFlags& output = request.output;
  TRY(WriteWanted(output.json_file, [&] { return TranslationJson(report); }));
  TRY(WriteWanted(output.csv_file, [&] { return TranslationCsv(report); }));
  TRY(DrawWanted(output.plot_file,
                 [&](const std::string& file) { return PlotTranslation(report, file); }));
  TRY(WriteWanted(output.html_file,
                  [&] { return DrawPage(TranslationDocument(report), TranslationJson(report)); }));
  TRY(WriteText(verb, [&] {
    return output.brief ? BriefTranslation(report) : TranslationText(report, LengthWanted(verb));
  }));
  if (report.interrupted) return kExitInterrupted;
  return report.Recommended() != nullptr ? kExitFine : kExitNotUsable;
}

}  // namespace

const Verb kTranslateVerb = {
    "translate", "Carry a measured curve to standard or any conditions, with its uncertainty",
    kTranslateFooter, "the report as text, --json, --csv, --plot and --html",
    Declare<TranslateRequest, DeclareTranslate, RunTranslate>};

}  // namespace lyrefit
