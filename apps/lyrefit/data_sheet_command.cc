#include <fmt/format.h>

#include <cmath>

#include "flags.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/devices/data_sheet.h"
#include "lyrefit/devices/device_documents.h"
#include "lyrefit/family/family_documents.h"
#include "lyrefit/model/pvlib_parameters.h"
#include "lyrefit/read/read_module.h"
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

// Parses `text` given to `flag`. A value with a percent sign is relative to `whole`, if that is
// given.
Expected<PrintedValue> ParsePrinted(const char* flag, const std::string& text, double whole = 0) {
  Expected<PrintedValue> printed = ReadPrintedValue(text, whole);
  if (!printed) return Fail(fmt::format("{}: {}", flag, printed.error().message));
  return printed;
}

struct DataSheetRequest {
  std::string file;
  // As printed: the digits give the rounding of each value.
  std::string isc;
  std::string voc;
  std::string imp;
  std::string vmp;
  std::string alpha;
  std::string beta;
  std::string gamma;
  std::string name;
  std::string technology;
  std::optional<double> EgRef_eV;
  std::optional<double> dEgdT_1_K;
  int cells = 1;
  bool exact = false;
  ConstantSet constants = ConstantSet::kCodata;
  ReportFlags output;
  std::string pvlib_file;
};

using Request = DataSheetRequest;
inline constexpr OptionRow<DataSheetRequest> kDataSheetTable[] = {
    OptionRow<Request>("Data sheet"),
    {"isc", "NUMBER", "short-circuit current in A", &Request::isc},
    {"voc", "NUMBER", "open-circuit voltage in V", &Request::voc},
    {"imp", "NUMBER", "current at the maximum power in A", &Request::imp},
    {"vmp", "NUMBER", "voltage at the maximum power in V", &Request::vmp},
    {"alpha", "NUMBER", "temperature coefficient of Isc in A/K, or in percent: 0.05%",
     &Request::alpha},
    {"beta", "NUMBER", "temperature coefficient of Voc in V/K, or in percent: -0.3%",
     &Request::beta},
    {"gamma", "NUMBER", "temperature coefficient of Pmp in percent per kelvin, only compared",
     &Request::gamma},
    {"cells", "N", "cells in series", &Request::cells, 1, 100000,
     OptionTrait::kQuiet | OptionTrait::kNoDefault},
    {"technology", "NAME",
     "of the cells, which sets the band gap: c-Si, HJT, CdTe, CIGS, a-Si, GaAs, perovskite, ...",
     &Request::technology},
    {"EgRef", "eV",
     "band gap at 25 C of De Soto's law (default: of the technology, 1.121 of silicon)",
     &Request::EgRef_eV, 0.3, 3.0, OptionTrait::kNoDefault},
    {"dEgdT", "1/K", "its slope with temperature, relative to it", &Request::dEgdT_1_K, -0.01, 0.01,
     OptionTrait::kNoDefault},
    {"exact", "", "the values are not rounded to the digits given", &Request::exact},
    {"constants", "NAME", "values of k and q", EnumOption<&Request::constants>()},
    OptionRow<Request>("Output"),
    {"name", "TEXT", "of the module, for pvlib (default module)", &Request::name},
};

// The flags of printed values.
struct PrintedFlag {
  const char* flag;
  std::string DataSheetRequest::*text;
  double DataSheetValues::*field;
  double DataSheetValues::*whole;  // base of a percentage; null: none
};
constexpr PrintedFlag kPrintedTable[] = {
    {"--isc", &Request::isc, &DataSheetValues::short_circuit_current_A, nullptr},
    {"--voc", &Request::voc, &DataSheetValues::open_circuit_voltage_V, nullptr},
    {"--imp", &Request::imp, &DataSheetValues::max_power_current_A, nullptr},
    {"--vmp", &Request::vmp, &DataSheetValues::max_power_voltage_V, nullptr},
    {"--alpha", &Request::alpha, &DataSheetValues::alpha_sc_A_K,
     &DataSheetValues::short_circuit_current_A},
    {"--beta", &Request::beta, &DataSheetValues::beta_oc_V_K,
     &DataSheetValues::open_circuit_voltage_V}};

void DeclareDataSheet(VerbLine* verb, DataSheetRequest* request) {
  ReportFlags& output = request->output;
  verb->AddOption("FILE", &request->file,
                  "a module whose sheet is meant: a PVsyst .PAN file, a row of SAM's library of "
                  "modules (FILE#NAME), what --pvlib wrote; the numbers given count before its own")
      .Reads();
  ForRows(kDataSheetTable, [&](const OptionRow<Request>& row, const std::string& heading) {
    AddRowFlag(verb, row, heading, request);
  });
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

// The sheet of the file, or an empty one.
Expected<ModuleSheet> SheetOfFile(const DataSheetRequest& request) {
  if (!request.file.empty()) return ReadModuleSheet(request.file);
  ModuleSheet module;
  for (const auto& row : kPrintedTable) module.sheet.values.*row.field = kUnknown;
  module.sheet.cells_in_series = 0;
  return module;
}

Error Missing(const DataSheetRequest& request, const char* flag) {
  if (request.file.empty()) return {fmt::format("{} is required, without a FILE", flag), {}};
  return {fmt::format("the file does not state the value: say {}", flag), request.file};
}

// The sheet of the flags and, for what they do not state, of the file.
Expected<ModuleSheet> Sheet(const VerbLine& verb, const DataSheetRequest& request) {
  TRY(ModuleSheet module, SheetOfFile(request));
  DataSheet& sheet = module.sheet;
  for (const auto& row : kPrintedTable) {
    double& value = sheet.values.*row.field;
    if (verb.Given(row.flag)) {
      const double whole = row.whole == nullptr ? 0 : sheet.values.*row.whole;
      TRY(const PrintedValue printed, ParsePrinted(row.flag, request.*row.text, whole));
      value = printed.value;
      sheet.half_unit.*row.field = printed.half_unit;
    }
    if (std::isnan(value)) return tl::unexpected(Missing(request, row.flag));
  }
  if (verb.Given("--cells")) sheet.cells_in_series = request.cells;
  if (sheet.cells_in_series == 0) return tl::unexpected(Missing(request, "--cells"));
  if (request.exact) sheet.half_unit = DataSheetValues();
  if (!request.name.empty()) module.name = request.name;
  if (!request.technology.empty()) sheet.technology = request.technology;
  if (request.EgRef_eV) sheet.EgRef_eV = request.EgRef_eV;
  if (request.dEgdT_1_K) sheet.dEgdT_1_K = request.dEgdT_1_K;
  if (module.name.empty()) module.name = "module";
  if (request.gamma.empty()) return module;
  TRY(const PrintedValue gamma, ParsePrinted("--gamma", request.gamma));
  sheet.gamma_pmp_percent_K = gamma.value;
  return module;
}

Expected<std::string> PvlibText(const ModuleSheet& module, const DataSheetFit& fit) {
  TRY(const auto keywords, PvlibParameters(fit.translation, fit.shared));
  const auto row = CecRow(fit.translation, fit.shared, module.name, module.sheet.technology);
  return PvlibJson(module.name, fit.translation.spec.law, keywords, row);
}

Expected<int> RunDataSheet(VerbLine& verb, DataSheetRequest& request) {
  TRY(verb.CheckFiles());
  TRY(const ModuleSheet module, Sheet(verb, request));
  TRY(DataSheetFit fit, FitDataSheet(module.sheet, request.constants));
  for (const std::string& assumption : module.assumptions) fit.warnings.push_back(assumption);
  if (module.has_model && !(fit.Solved() && fit.usual)) {
    fit.warnings.push_back(fmt::format(
        "the file states a device of its own, with its series and shunt resistance and ideality: "
        "lyrefit simulate --from '{}' takes that",
        request.file));
  }
  TRY(WriteWanted(request.output.json_file, [&] { return DataSheetJson(fit); }));
  TRY(WriteWanted(request.output.csv_file, [&] { return DataSheetCsv(fit); }));
  if (!request.pvlib_file.empty()) {
    TRY(const std::string json, PvlibText(module, fit));
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
