#include <fmt/format.h>

#include <filesystem>

#include "flags.h"
#include "lyrefit/base/file.h"
#include "lyrefit/base/try.h"
#include "lyrefit/estimate/fit/simulate.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/write_curve.h"
#include "lyrefit/simulate/read_string_layout.h"
#include "lyrefit/simulate/simulate_module.h"
#include "output.h"
#include "verbs.h"

namespace lyrefit {
namespace {

constexpr char kSimulateFooter[] =
    "Examples:\n"
    "  lyrefit simulate --set Iph=0.76 --set Is1=3e-7 --set n1=1.48 --set Rs=0.036 --set Rsh=54\n"
    "      --temperature-C 33 --noise-A 0.0005 --seed 1 --out cell.csv\n"
    "  lyrefit simulate --from fit.json --voltages 0:0.6:61\n"
    "  lyrefit simulate --from fit.json --with shading:d=0.3,w=0.3333\n"
    "  lyrefit simulate --from fit.json --string half_cut.json\n"
    "  lyrefit simulate --from module.PAN --irradiance-Wm2 800 --temperature-C 45\n"
    "\n"
    "Beside NAME.csv a file NAME.json holds the conditions; lyrefit fit NAME.csv reads both.";

// Path of the sidecar NAME.json of NAME.csv; empty for standard output.
std::string SidecarOf(const std::string& table) {
  if (table == "-") return "";
  return std::filesystem::path(table).replace_extension(".json").string();
}

// Whether table and sidecar equal, byte for byte, the output of this verb for their curve.
bool IsOwnWork(const std::string& table) {
  const Expected<IvCurve> curve = ReadCurve(table);
  if (!curve) return false;
  const std::uintmax_t largest = ReadOptions().largest_file_bytes;
  const Expected<std::string> csv = ReadTextFile(table, largest);
  const Expected<std::string> json = ReadTextFile(SidecarOf(table), largest);
  return csv && json && *csv == CurveToCsv(*curve) && *json == CurveSidecarJson(*curve);
}

struct SimulateRequest {
  SimulateOptions options;
  ConditionOptions conditions;
  std::string from_file;
  std::string from_curve;
  std::string layout_file;
  std::string voltages;
  std::string out_file = "-";
};

void DeclareSimulate(VerbLine* verb, SimulateRequest* request) {
  AddNamedFlags(verb, kSimulateOptionTable, {"model", "junctions", "set"}, &request->options);
  verb->AddOption(
          "--from", &request->from_file,
          "parameters and conditions of a JSON fit report; or a module: pvlib's parameters as "
          "JSON, a PVsyst .PAN file, a row of SAM's library of modules (FILE#NAME), a report of "
          "fit --family, by its law at --irradiance-Wm2 and --temperature-C")
      .Group("Device")
      .Type("FILE")
      .Reads();
  verb->AddOption("--curve", &request->from_curve, "which curve of a report of many, by its id")
      .Group("Device")
      .Type("ID");
  AddTableFlags(verb, kSimulateOptionTable, &request->options, "Device");
  verb->AddOption("--string", &request->layout_file,
                  "cells that are not alike, their bypass diodes and reverse law, as JSON")
      .Group("Device")
      .Type("FILE")
      .Reads();
  AddTableFlags(verb, kConditionOptionTable, &request->conditions);
  verb->AddOption("--voltages", &request->voltages, "even steps in volt, both ends included")
      .Type("FROM:TO:COUNT")
      .Group("Points");
  AddRowFlag(verb, *FindRow(kSimulateOptionTable, "points"), "Points", &request->options)
      .Excludes("--voltages");
  AddTableFlags(verb, kSimulateOptionTable, &request->options);
  verb->AddOption("--out", &request->out_file, "where to write; - for standard output (default -)")
      .Writes();
}

Expected<void> CheckTargets(VerbLine* verb, const std::string& out_file) {
  if (out_file == "-") return verb->CheckFiles();
  const std::string sidecar = SidecarOf(out_file);
  if (out_file == sidecar) {
    return Fail("--out: expected a table that ends in .csv, found .json", out_file);
  }
  verb->AlsoWrites("--out", sidecar);
  TRY(verb->CheckFiles());
  if (verb->Forced()) return {};
  for (const std::string& file : {out_file, sidecar}) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error) || IsOwnWork(out_file)) continue;
    return Fail(
        "--out: the file is there and holds something else than a simulated curve: name "
        "another file, or say --force to replace it",
        file);
  }
  return {};
}

// Options from the report of --from, unless a flag sets them.
Expected<void> TakeFrom(const VerbLine& verb, const SimulateRequest& request,
                        SimulateOptions* options) {
  if (request.from_file.empty() && !request.from_curve.empty()) {
    return Fail("--curve is about a report of many curves: it needs --from");
  }
  if (request.from_file.empty()) return {};
  IvCurve checked;
  TRY(ApplyConditionFlags(request.conditions, &checked));
  TRY(const DeviceToSimulate device,
      ReadForSimulation(request.from_file, request.from_curve, request.conditions));
  PrintRemarks(device.warnings);
  SimulateOptions fit = device.options;
  for (const auto& [name, value] : options->parameters) fit.parameters[name] = value;
  options->parameters = fit.parameters;
  options->conditions = fit.conditions;
  fit.with.insert(fit.with.end(), options->with.begin(), options->with.end());
  options->with = fit.with;
  options->taken = fit.taken;
  options->shared = fit.shared;
  options->force_effects = fit.force_effects;
  options->recombination = fit.recombination;
  if (!verb.Given("--model")) options->model = fit.model;
  if (!verb.Given("--junctions")) options->junctions = fit.junctions;
  if (!verb.Given("--constants")) options->constants = fit.constants;
  return {};
}

Expected<SimulateOptions> WholeOptions(const VerbLine& verb, const SimulateRequest& request) {
  SimulateOptions options = request.options;
  TRY(TakeFrom(verb, request, &options));
  options.force_effects = options.force_effects || verb.Forced();
  if (!request.layout_file.empty()) {
    TRY(StringLayout layout, ReadStringLayout(request.layout_file));
    options.layout = std::make_shared<const StringLayout>(std::move(layout));
  }
  if (!request.voltages.empty()) {
    TRY(options.voltage_V, ParseSteps("--voltages", request.voltages));
  }
  IvCurve told;
  told.conditions = options.conditions;
  TRY(ApplyConditionFlags(request.conditions, &told));
  options.conditions = told.conditions;
  const bool cells_told = !request.from_file.empty() || request.conditions.cells.has_value();
  if (options.layout != nullptr && !cells_told) {
    options.conditions.cells_in_series = options.layout->cells_in_series;
  }
  if (request.out_file != "-") {
    options.name = std::filesystem::path(request.out_file).stem().string();
  }
  return options;
}

Expected<int> RunSimulate(VerbLine& verb, SimulateRequest& request) {
  TRY(const SimulateOptions options, WholeOptions(verb, request));
  TRY(CheckTargets(&verb, request.out_file));
  TRY(const IvCurve curve, Simulate(options));
  TRY(WriteOutput(request.out_file, CurveToCsv(curve)));
  if (request.out_file == "-") return kExitFine;
  TRY(WriteTextFile(SidecarOf(request.out_file), CurveSidecarJson(curve)));
  return kExitFine;
}

}  // namespace

const Verb kSimulateVerb = {"simulate",
                            "Write the curve of a device, with noise if wanted",
                            kSimulateFooter,
                            "the curve alone, as a table: --out FILE.csv",
                            Declare<SimulateRequest, DeclareSimulate, RunSimulate>,
                            VerbKind::kPromised};

}  // namespace lyrefit
