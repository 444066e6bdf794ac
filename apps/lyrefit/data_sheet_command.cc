#include "flags.h"
#include "lyrefit/base/try.h"
#include "lyrefit/devices/device_documents.h"
#include "lyrefit/devices/stated_sheet.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json.h"
#include "lyrefit/report/page.h"
#include "lyrefit/report/plots.h"
#include "verbs.h"

namespace lyrefit {
namespace {

constexpr char kDataSheetFooter[] =
    "Examples:\n"
    "  lyrefit datasheet --isc 4.75 --voc 21.6 --imp 4.26 --vmp 17.6 --alpha 0.002 --beta -0.076\n"
    "      --cells 36\n"
    "  lyrefit datasheet --isc 9.05 --voc 37.8 --imp 8.58 --vmp 30.3 --alpha 0.06% --beta -0.31%\n"
    "      --gamma -0.41 --cells 60 --pvlib module.json\n"
    "  lyrefit datasheet module.PAN\n"
    "  lyrefit datasheet 'CEC Modules.csv#Acme 300' --beta -0.31%\n"
    "\n"
    "Exit codes: 0 fine, 1 bad input or options, 2 no device gives all that the sheet prints.";

struct DataSheetRequest {
  StatedSheet sheet;
  ReportFlags output;
  std::string pvlib_file;
};

void DeclareDataSheet(VerbLine* verb, DataSheetRequest* request) {
  ReportFlags& output = request->output;
  verb->AddOption("FILE", &request->sheet.file,
                  "a module whose sheet is meant: a PVsyst .PAN file, a row of SAM's library of "
                  "modules (FILE#NAME), what --pvlib wrote; the numbers given count before its own")
      .Reads();
  AddTableFlags(verb, kStatedSheetTable, &request->sheet);
  verb->AddOption("--json", &output.json_file, "the answer as JSON; - for standard output, alone")
      .Writes();
  verb->AddOption("--pvlib", &request->pvlib_file,
                  "the parameters as pvlib takes them, JSON; - for standard output, alone")
      .Writes();
  AddCsvFlag(verb, "the parameters as a table, a row each", &output);
  verb->AddOption("--plot", &output.plot_file,
                  "all devices through the sheet's points as a picture, .svg, .png or .pdf")
      .Draws();
  AddHtmlFlag(verb, "answer", &output);
  verb->AddQuietSwitch();
}

Expected<int> RunDataSheet(VerbLine& verb, DataSheetRequest& request) {
  TRY(verb.CheckFiles());
  TRY(const FittedSheet sheet, FitStatedSheet(request.sheet));
  const DataSheetFit& fit = sheet.fit;
  TRY(WriteWanted(request.output.json_file, [&] { return DataSheetJson(fit); }));
  TRY(WriteWanted(request.output.csv_file, [&] { return DataSheetCsv(fit); }));
  if (!request.pvlib_file.empty()) {
    TRY(const std::string json, PvlibText(sheet));
    TRY(WriteOutput(request.pvlib_file, json));
  }
  TRY(DrawWanted(request.output.plot_file,
                 [&](const std::string& file) { return PlotDataSheet(fit, file); }));
  TRY(WriteWanted(request.output.html_file,
                  [&] { return DrawPage(DataSheetDocument(fit), DataSheetJson(fit)); }));
  TRY(WriteText(verb, [&] { return DataSheetText(fit); }));
  return fit.Solved() ? kExitFine : kExitNotUsable;
}

}  // namespace

const Verb kDataSheetVerb = {
    "datasheet", "Find a module's parameters from what its data sheet prints, without any curve",
    kDataSheetFooter, "the parameters as text, --json, --csv, --pvlib, --plot and --html",
    Declare<DataSheetRequest, DeclareDataSheet, RunDataSheet>};

}  // namespace lyrefit
