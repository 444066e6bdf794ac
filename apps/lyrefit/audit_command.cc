#include "audit_command.h"

#include "flags.h"
#include "interrupt.h"
#include "lyrefit/study/report/audit_csv.h"
#include "lyrefit/study/report/audit_json.h"
#include "lyrefit/study/report/documents.h"
#include "output.h"

namespace lyrefit {
namespace {

constexpr char kAuditFooter[] =
    "ROWS is a table with the columns source, device, model (sd, dd, td), algorithm, rmse_A (the\n"
    "claim), Iph_A, Rs_ohm, Rsh_ohm, Is1_A (or Is1_uA), n1, Is2_A, n2, Is3_A, n3, and if you like\n"
    "temperature_C, cells, constants, bounds, note. Copy the numbers as they are printed: their\n"
    "last digits say how nearly a claim must come out. Resistances are those of the module, n is\n"
    "per cell. A device is a curve's folder or file beside ROWS, in the folder above it, or in a\n"
    "folder given with --curves.\n"
    "\n"
    "Examples:\n"
    "  lyrefit audit data/paper/rows.csv\n"
    "  lyrefit audit rows.csv --curves my_curves --json audit.json\n"
    "\n"
    "Exit codes: 0 all rows were read, whatever the verdicts; 1 some row could not be.";

}  // namespace

AuditCommand::AuditCommand(CommandLine* line)
    : verb_(line->AddVerb("audit",
                          "Check published parameter rows: does the claimed RMSE come out?")) {
  verb_->AddOption("ROWS", &rows_file_, "table of published rows, see below").Required().Reads();
  AddListFlag(verb_, "--curves", "a folder to look for the devices' curves in; may be repeated",
              &options_.curve_folders)
      .Type("DIR");
  verb_
      ->AddReader("--constants", EnumReader<ConstantSet>(&options_.constants),
                  "values of k and q of rows that do not say: " + AllTexts<ConstantSet>() +
                      " (default: any)")
      .Type("NAME");
  AddEnumFlag(verb_, "--objective", "which RMSE the claims are of", &options_.objective);
  verb_->AddOption("--json", &json_file_, "the audit as JSON; - for standard output, alone")
      .Writes();
  verb_->AddOption("--csv", &csv_file_, "the findings as a table; - for standard output, alone")
      .Writes();
  verb_->AddSwitch("--brief", &brief_, "one line a row instead of the whole report")
      .Group("Output");
  verb_->AddQuietSwitch();
  verb_->Footer(kAuditFooter);
}

int AuditCommand::Run() {
  EndOnSignals();
  if (auto checked = verb_->CheckFiles(); !checked) return Refuse(checked.error());
  const Expected<AuditReport> report = Audit(rows_file_, options_);
  if (!report) return Refuse(report.error());
  if (!json_file_.empty()) {
    if (auto written = WriteOutput(json_file_, AuditJson(*report)); !written) {
      return Refuse(written.error());
    }
  }
  if (!csv_file_.empty()) {
    if (auto written = WriteOutput(csv_file_, AuditCsv(*report)); !written) {
      return Refuse(written.error());
    }
  }
  if (verb_->TextWanted()) {
    auto written = WriteOutput("-", brief_ ? BriefAudit(*report) : AuditText(*report));
    if (!written) return Refuse(written.error());
  }
  return report->bad_rows.empty() ? kExitFine : kExitBadInput;
}

}  // namespace lyrefit
