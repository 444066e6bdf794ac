#include "flags.h"
#include "interrupt.h"
#include "lyrefit/base/try.h"
#include "lyrefit/devices/describe_cell.h"
#include "lyrefit/devices/device_documents.h"
#include "lyrefit/read/read_cell.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json.h"
#include "lyrefit/report/page.h"
#include "lyrefit/report/plots.h"
#include "verbs.h"

namespace lyrefit {
namespace {

constexpr char kCellFooter[] =
    "Examples:\n"
    "  lyrefit cell pixel.csv --area-cm2 0.16 --html cell.html\n"
    "  lyrefit cell lit.csv dark.csv suns_voc.csv --json cell.json --plot cell.svg\n"
    "  lyrefit cell up.txt down.txt --column 'a_Forward_Light' --brief\n"
    "\n"
    "All files are of one cell: sweeps up and down, lit and dark, at several lights, and Suns-Voc\n"
    "traces, in any combination. A file of several cells needs --column.\n"
    "\n"
    "Exit codes: 0 fine, 1 bad input or options, 2 no sweep has a usable fit.";

struct CellRequest {
  std::vector<std::string> files;
  ReadOptions reading;
  bool list_columns = false;
  ConditionOptions conditions;
  CellOptions options;
  ReportFlags output;
};

void DeclareCell(VerbLine* verb, CellRequest* request) {
  verb->AddOption("FILE", &request->files, "files or folders of one cell").ReadsCurves();
  AddColumnFlags(verb, &request->reading, &request->list_columns);
  AddTableFlags(verb, kConditionOptionTable, &request->conditions);
  AddTableFlags(verb, kCellOptionTable, &request->options);
  AddReportFlags(verb, "cell", "the sweeps as a table, a row each", "curves and losses",
                 &request->output);
  verb->AddSwitch("--full-plot", &request->output.full_plot, "all points in pictures")
      .Group("Output");
}

Expected<CurveSet> ReadFlaggedCell(const CellRequest& request) {
  ConditionOptions conditions = request.conditions;
  TRY(CurveSet cell, ReadCell(request.files, request.reading, conditions.irradiance_W_m2));
  if (cell.curves.size() > 1) conditions.irradiance_W_m2.reset();  // of each that states none
  TRY(ApplyConditionFlags(conditions, &cell));
  return cell;
}

Expected<int> RunCell(VerbLine& verb, CellRequest& request) {
  if (request.files.empty()) return Fail("FILE is required: the measurements of a cell");
  if (request.list_columns) return PrintInspections(request.files, request.reading);
  const ReportFlags& output = request.output;
  TRY(verb.CheckFiles());
  TRY(const CurveSet cell, ReadFlaggedCell(request));
  const InterruptGuard guard;
  TRY(const CellReport report, DescribeCell(cell, request.options, TerminalObserver()));
  TRY(WriteWanted(output.json_file, [&] { return CellJson(report); }));
  TRY(WriteWanted(output.csv_file, [&] { return CellCsv(report); }));
  TRY(DrawWanted(output.plot_file,
                 [&](const std::string& file) { return PlotCell(report, file, output.marks()); }));
  TRY(WriteWanted(output.html_file,
                  [&] { return DrawPage(CellDocument(report), CellJson(report)); }));
  TRY(WriteText(verb, [&] {
    return output.brief ? BriefCell(report) : CellText(report, LengthWanted(verb));
  }));
  if (report.interrupted) return kExitInterrupted;
  return report.Usable() ? kExitFine : kExitNotUsable;
}

}  // namespace

const Verb kCellVerb = {"cell", "Describe the measurements of a laboratory cell", kCellFooter,
                        "the cell as text, --json, --csv, --plot and --html",
                        Declare<CellRequest, DeclareCell, RunCell>};

}  // namespace lyrefit
