#include "flags.h"
#include "lyrefit/base/try.h"
#include "lyrefit/study/audit.h"
#include "lyrefit/study/report/documents.h"
#include "verbs.h"

namespace lyrefit {
namespace {

constexpr char kAuditFooter[] =
    "ROWS is a table with the columns source, device, model (sd, dd, td), algorithm, rmse_A (the\n"
    "claim; a sum of squares in sse_A2), Iph_A, Rs_ohm, Rsh_ohm, Is1_A (or Is1_uA), n1, Is2_A, "
    "n2,\n"
    "Is3_A, n3, and if you like objective, temperature_C, cells, constants, bounds, note. Copy "
    "the\n"
    "numbers as they are printed: their last digits say how nearly a claim must come out.\n"
    "Resistances are those of the module, n is per cell. Without any parameters a claim is held\n"
    "against the lowest RMSE there is. A device is a curve's folder or file beside ROWS, in the\n"
    "folder above it, or in a folder given with --curves.\n"
    "\n"
    "Examples:\n"
    "  lyrefit audit data/paper/rows.csv\n"
    "  lyrefit audit data/published/rows.csv\n"
    "  lyrefit audit rows.csv --curves my_curves --json audit.json\n"
    "\n"
    "Exit codes: 0 all rows were read, whatever the verdicts; 1 some row could not be.";

struct AuditRequest {
  std::string rows_file;
  AuditOptions options;
  ReportFlags output;
};

void DeclareAudit(VerbLine* verb, AuditRequest* request) {
  ReportFlags& output = request->output;
  verb->AddOption("ROWS", &request->rows_file, "table of published rows, see below")
      .Required()
      .Reads();
  AddTableFlags(verb, kAuditOptionTable, &request->options);
  verb->AddOption("--json", &output.json_file, "the audit as JSON; - for standard output, alone")
      .Writes();
  AddCsvFlag(verb, "the findings as a table", &output);
  verb->AddSwitch("--brief", &output.brief, "one line a row instead of the whole report")
      .Group("Output");
  verb->AddQuietSwitch();
}

Expected<int> RunAudit(VerbLine& verb, AuditRequest& request) {
  const ReportFlags& output = request.output;
  TRY(verb.CheckFiles());
  TRY(const AuditReport report, Audit(request.rows_file, request.options));
  if (!report.remark.empty()) PrintRemarks({report.path + ": " + report.remark});
  TRY(WriteWanted(output.json_file, [&] { return AuditJson(report); }));
  TRY(WriteWanted(output.csv_file, [&] { return AuditCsv(report); }));
  TRY(WriteText(verb, [&] { return output.brief ? BriefAudit(report) : AuditText(report); }));
  return report.bad_rows.empty() ? kExitFine : kExitBadInput;
}

}  // namespace

const Verb kAuditVerb = {"audit", "Check published parameter rows: does the claimed RMSE come out?",
                         kAuditFooter, "the findings as text, --json and --csv",
                         Declare<AuditRequest, DeclareAudit, RunAudit>};

}  // namespace lyrefit
