#include "flags.h"
#include "interrupt.h"
#include "lyrefit/base/try.h"
#include "lyrefit/family/fit_family.h"
#include "lyrefit/study/coverage.h"
#include "lyrefit/study/report/coverage_csv.h"
#include "lyrefit/study/report/coverage_json.h"
#include "lyrefit/study/report/documents.h"
#include "verbs.h"

namespace lyrefit {
namespace {

constexpr char kCoverageFooter[] =
    "Examples:\n"
    "  lyrefit coverage --sets 500\n"
    "  lyrefit coverage --law pvsyst --model dd --sets 200 --json coverage.json\n"
    "  lyrefit coverage --temperature-error 2 --temperature-offset\n"
    "  lyrefit coverage --cells 36 --set Iph=4.715 --set Is1=6.35e-10 --set n1=1.03\n"
    "      --set Rs=0.282 --set Rsh=85.8 --set alpha=0.002 --set Eg=1.0386\n"
    "\n"
    "Every set is simulated from known parameters on the irradiances and temperatures of IEC\n"
    "61853-1, with noise, and fitted jointly. Same seed, same answer on any number of threads.";

struct CoverageRequest {
  CoverageOptions options;
  ReportFlags output;
};

void DeclareCoverage(VerbLine* verb, CoverageRequest* request) {
  CoverageOptions& options = request->options;
  ReportFlags& output = request->output;
  AddTableFlags(verb, kCoverageOptionTable, &options, "Device");
  AddTableFlags(verb, kCoverageOptionTable, &options, "Sets");
  AddResumeFlag(verb, "set", &options.journal);
  AddTableFlags(verb, kCoverageOptionTable, &options);
  verb->AddOption("--json", &output.json_file, "everything as JSON; - for standard output, alone")
      .Writes();
  AddCsvFlag(verb, "the parameters as a table, a row each", &output);
  verb->AddQuietSwitch();
}

Expected<int> RunCoverage(VerbLine& verb, CoverageRequest& request) {
  const ReportFlags& output = request.output;
  TRY(verb.CheckFiles());
  const InterruptGuard guard;
  TRY(const CoverageReport report,
      Coverage(request.options, FitFamily, TerminalObserver({"coverage"})));
  PrintRemarks(report.remarks);
  TRY(WriteWanted(output.json_file, [&] { return CoverageJson(report); }));
  TRY(WriteWanted(output.csv_file, [&] { return CoverageCsv(report); }));
  TRY(WriteText(verb, [&] { return CoverageText(report); }));
  if (report.interrupted) return kExitInterrupted;
  if (report.journal_lacks_sets) return kExitBadInput;
  return report.failed < static_cast<int>(report.sets.size()) ? kExitFine : kExitNotUsable;
}

}  // namespace

const Verb kCoverageVerb = {
    "coverage", "Count how often the 95 % intervals of joint fits hold the truth", kCoverageFooter,
    "the counts as text, --json and --csv", Declare<CoverageRequest, DeclareCoverage, RunCoverage>};

}  // namespace lyrefit
