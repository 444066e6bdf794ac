#include <pybind11/stl.h>

#include <map>
#include <memory>
#include <string>

#include "bindings.h"
#include "curves.h"
#include "docs.h"
#include "effects.h"
#include "errors.h"
#include "lyrefit/base/constants.h"
#include "lyrefit/estimate/fit/simulate.h"
#include "lyrefit/simulate/read_string_layout.h"
#include "lyrefit/simulate/simulate_module.h"
#include "result.h"
#include "work.h"

namespace lyrefit::python {
namespace {

constexpr char kSimulateDoc[] =
    "Solve the curve of a device: I(V) to rounding, then noise if wanted.\n\n"
    "Parameters\n----------\n"
    "parameters : mapping of str to float, Result, path, optional\n"
    "    Of the model, under pvlib's names or the papers' symbols (photocurrent or Iph in A,\n"
    "    saturation_current or Is1 in A, resistance_series or Rs and resistance_shunt or Rsh in\n"
    "    ohm, n or n1 per cell); nNsVth in V in the place of n. Or a fit: what fit() gave, or the\n"
    "    file of its JSON, whose conditions and effects then count. A shunt of inf is perfect.\n"
    "    Or a module by its law at irradiance_Wm2 and temperature_C: a file of pvlib's parameters\n"
    "    as JSON, a PVsyst .PAN file, a row of SAM's library of modules ('FILE#NAME'), or a fit\n"
    "    of a family.\n"
    "    Each may be a keyword of its own.\n"
    "voltage : array_like of shape (n,), optional\n"
    "    Where to solve, in V; else `points` even steps from 0 to 2 % beyond open circuit.\n"
    "string : path, optional\n"
    "    JSON of cells that are not alike, their bypass diodes and reverse law.\n"
    "curve_id : str, optional\n"
    "    Which curve of a report of many.\n";

constexpr char kSimulateEnd[] =
    "Returns\n-------\n"
    "Curve\n"
    "    With `voltage` and `current`, each of shape (n,).\n\n"
    "Raises\n------\n"
    "lyrefit.Error\n"
    "    A parameter that is missing, unknown or outside its physical range, no open-circuit\n"
    "    voltage to end at.\n\n"
    "Examples\n--------\n"
    ">>> curve = lyrefit.simulate(photocurrent=0.7608, saturation_current=3.1e-7, n=1.477,\n"
    "...                          resistance_series=0.0365, resistance_shunt=52.9,\n"
    "...                          temperature_C=33)\n"
    ">>> curve.current.max()\n";

// Keywords that are parameters of a device, for all models.
constexpr const char* kParameterKeywords[] = {
    "photocurrent", "saturation_current",   "n",   "resistance_series",    "resistance_shunt",
    "nNsVth",       "saturation_current_2", "n_2", "saturation_current_3", "n_3"};

using ParameterMap = std::map<std::string, double>;

void SetParameters(py::handle values, ParameterMap* parameters) {
  for (const auto& [name, value] : py::dict(py::reinterpret_borrow<py::object>(values))) {
    const std::string text = TextOf("parameters", name);
    (*parameters)[text] = NumberOf(text, value);
  }
}

// The device to simulate, before the keywords are applied.
SimulateOptions DeviceOf(py::handle parameters, const std::string& curve_id,
                         const ConditionOptions& told) {
  SimulateOptions options;
  if (parameters.is_none()) return options;
  if (py::isinstance<Result>(parameters)) {
    const std::string json = parameters.cast<const Result&>().FullJson();
    return Must(ReadReportForSimulation(json, "the fit", curve_id, told));
  }
  if (IsPath(parameters)) {
    DeviceToSimulate device =
        Must(ReadForSimulation(TextOf("parameters", parameters), curve_id, told));
    for (const std::string& warning : device.warnings) Warn(warning);
    return std::move(device.options);
  }
  if (!py::hasattr(parameters, "keys")) {
    Raise({"parameters: expected a mapping, a fit or a path", {}});
  }
  SetParameters(parameters, &options.parameters);
  return options;
}

// Converts pvlib's n Ns Vth to the ideality of a cell.
void TakeModifiedIdeality(const Conditions& conditions, ConstantSet constants,
                          ParameterMap* parameters) {
  const auto given = parameters->find("nNsVth");
  if (given == parameters->end()) return;
  (*parameters)["n"] = given->second / conditions.ModuleThermalVoltage(constants);
  parameters->erase("nNsVth");
}

void TakeLayout(Keywords* keywords, bool cells_told, SimulateOptions* options) {
  const auto layout = keywords->Take("string");
  if (!layout) return;
  options->layout =
      std::make_shared<const StringLayout>(Must(ReadStringLayout(TextOf("string", *layout))));
  if (!cells_told) options->conditions.cells_in_series = options->layout->cells_in_series;
}

SimulateOptions ReadSimulateKeywords(py::handle parameters, Keywords* keywords, OwnEffects* own) {
  std::string curve_id;
  if (const auto id = keywords->Take("curve_id")) curve_id = TextOf("curve_id", *id);
  ConditionOptions told;
  keywords->Read(kConditionOptionTable, &told);
  SimulateOptions options = DeviceOf(parameters, curve_id, told);
  const bool from_fit = options.taken.has_value() || options.shared.has_value() ||
                        (!parameters.is_none() && !py::hasattr(parameters, "keys")) ||
                        py::isinstance<Result>(parameters);
  for (const char* name : kParameterKeywords) {
    if (const auto value = keywords->Take(name)) options.parameters[name] = NumberOf(name, *value);
  }
  if (const auto with = keywords->Take("with_")) {
    EffectsAsked effects = EffectsOf(*with);
    for (EffectUse& use : effects.uses) options.with.push_back(std::move(use));
    *own = std::move(effects.own);
  }
  TakeLayout(keywords, from_fit || told.cells.has_value(), &options);
  IvCurve conditions;
  conditions.conditions = options.conditions;
  ApplyTold(told, &conditions);
  options.conditions = conditions.conditions;
  if (const auto name = keywords->Take("name")) options.name = TextOf("name", *name);
  keywords->Read(kSimulateOptionTable, &options);
  TakeModifiedIdeality(options.conditions, options.constants, &options.parameters);
  return options;
}

IvCurve SimulateOne(py::handle parameters, py::handle voltage, const py::kwargs& given) {
  Keywords keywords("simulate", given);
  OwnEffects own;
  SimulateOptions options = ReadSimulateKeywords(parameters, &keywords, &own);
  keywords.Finish();
  if (!voltage.is_none()) options.voltage_V = NumbersOf("voltage", voltage);
  if (!voltage.is_none() && options.voltage_V.empty()) {
    Raise({"voltage: expected at least one, found none", {}});
  }
  Expected<IvCurve> curve = Unlocked([&] { return Simulate(options); });
  FaultsOf(own).Raise();
  return Must(std::move(curve));
}

constexpr char kRmseDoc[] =
    "Tell the RMSE of given parameters on a curve, by both definitions in use.\n\n"
    "The measured-current RMSE puts the measured current into the right-hand side of the diode\n"
    "equation; the solved-current RMSE is of the current that solves it. Papers mostly give the\n"
    "measured-current one, each at its own optimum: never compare one with the other.\n\n"
    "Parameters\n----------\n"
    "curve : array_like of shape (2, n) or (n, 2), Curve, path, mapping or DataFrame\n"
    "    As fit() takes it in one piece; (voltage, current) in V and A.\n"
    "parameters : mapping of str to float, or FitResult\n"
    "    Under pvlib's names or the papers' symbols, of the whole device: photocurrent or Iph and\n"
    "    saturation_current or Is1 in A, resistance_series or Rs and resistance_shunt or Rsh in\n"
    "    ohm, n or n1 per cell, or nNsVth in V in its place; saturation_current_2 (Is2), n_2 (n2)\n"
    "    and so on for two and three diodes. Or the answer of a fit of diodes alone.\n";

constexpr char kRmseEnd[] =
    "Returns\n-------\n"
    "dict of str to float\n"
    "    ``measured_current_A`` and ``solved_current_A``, in A, as in ``result['rmse']`` of "
    "fit().\n\n"
    "Raises\n------\n"
    "lyrefit.Error\n"
    "    A parameter that is missing, unknown or outside its physical range, an unusable curve.\n\n"
    "Examples\n--------\n"
    ">>> lyrefit.rmse(\"data/rtc_france\", {\"Iph\": 0.760776, \"Is1\": 3.23021e-7, \"n1\": "
    "1.481184,\n"
    "...                                   \"Rs\": 0.036377, \"Rsh\": 53.7185})\n";

struct RmseOptions {
  ConstantSet constants = ConstantSet::kCodata;
};

constexpr OptionRow<RmseOptions> kRmseOptionTable[] = {
    {"constants", "NAME", "values of k and q", EnumOption<&RmseOptions::constants>()},
};

py::dict RmseOfOne(py::handle curve, py::handle parameters, const py::kwargs& given) {
  Keywords keywords("rmse", given);
  RmseOptions options;
  keywords.Read(kRmseOptionTable, &options);
  const IvCurve taken = TakeCurve(curve, py::none(), &keywords);
  keywords.Finish();
  py::object values = py::reinterpret_borrow<py::object>(parameters);
  if (py::isinstance<Result>(parameters) && py::hasattr(parameters, "parameters")) {
    values = parameters.attr("parameters");
  } else if (py::isinstance<Result>(parameters) || !py::hasattr(parameters, "keys")) {
    Raise({"parameters: expected a mapping or a fit", {}});
  }
  ParameterMap named;
  SetParameters(values, &named);
  if (named.count("nNsVth") + named.count("n") + named.count("n1") > 1) {
    Raise({"parameters: n and nNsVth say the same: give one of them", {}});
  }
  TakeModifiedIdeality(taken.conditions, options.constants, &named);
  const RmsePair rmse = Must(RmseOf(taken, named, options.constants));
  py::dict both;
  both["measured_current_A"] = rmse.measured_current_A;
  both["solved_current_A"] = rmse.solved_current_A;
  return both;
}

std::vector<KeywordNote> RmseNotes() {
  std::vector<KeywordNote> notes;
  AppendNotes(kRmseOptionTable, RmseOptions(), &notes);
  AppendCurveNotes(&notes);
  return EachOnce(notes);
}

std::vector<KeywordNote> SimulateNotes() {
  std::vector<KeywordNote> notes;
  for (const char* name : kParameterKeywords) {
    notes.push_back({name, "float", "None", "Device", ""});
  }
  AppendNotes(kSimulateOptionTable, SimulateOptions(), &notes);
  AppendNotes(kConditionOptionTable, ConditionOptions(), &notes);
  notes.push_back({"name", "str", "'simulated'", "Device", "of the curve"});
  notes.push_back({"string", "str | PathLike[str]", "None", "Device", ""});
  notes.push_back({"curve_id", "str", "None", "Device", ""});
  return notes;
}

}  // namespace

void BindSimulate(py::module_* module) {
  DefineVerb(module,
             {"simulate", "parameters=None, voltage=None", kSimulateDoc, kSimulateEnd,
              SimulateNotes(), true},
             &SimulateOne, py::arg("parameters") = py::none(), py::arg("voltage") = py::none());
  DefineVerb(module, {"rmse", "curve, parameters", kRmseDoc, kRmseEnd, RmseNotes()}, &RmseOfOne,
             py::arg("curve"), py::arg("parameters"));
}

}  // namespace lyrefit::python
