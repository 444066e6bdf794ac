#include "bindings.h"
#include "effects.h"
#include "keywords.h"
#include "lyrefit/cite/references.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/estimate/fit/effect_text.h"

namespace lyrefit::python {

std::shared_ptr<OwnEffect> MakeOwnEffect(const py::handle& id, const py::handle& parameters,
                                         const py::kwargs& given);

namespace {

constexpr char kEffectDoc[] =
    "Effect(id, parameters, *, junction=None, series=None, junction_derivatives=None,\n"
    "       series_derivatives=None, probes=None, title=None, equation='', sentence='', needs='',\n"
    "       acts='', separate_by='', action='', reference='')\n--\n\n"
    "An effect of your own: what the diode model lacks, as functions of arrays.\n\n"
    "Experimental: may change in a minor version.\n\n"
    "It is fitted, simulated and diagnosed like those of the catalogue: ``fit(curve,\n"
    "with_=[effect])``, ``simulate(..., with_=[(effect, {'k': 0.02})])``, ``diagnose(curve,\n"
    "own_effects=[effect])``. Fits with it use one thread; the same call gives the same digits.\n\n"
    "Parameters\n----------\n"
    "id : str\n"
    "    Its name in reports and JSON.\n"
    "parameters : dict\n"
    "    ``{'k': (lower, upper)}``, or ``{'k': {'bounds': (lower, upper), 'start': 0.0, 'name': "
    "...,\n"
    "    'unit': ..., 'doc': ..., 'current_power': 0, 'cells_power': 0}}``. The first is the\n"
    "    strength: at its start (0 where that is inside the bounds) no effect must be there. What "
    "is\n"
    "    reported is the value times (current scale in A)**current_power * cells**cells_power.\n"
    "junction : callable, optional\n"
    "    ``junction(voltage, k, m, ...)``: what is added to the delivered current at these "
    "junction\n"
    "    voltages. `voltage` is an array of shape (n,), V of one cell; the parameters are floats;\n"
    "    the answer is an array of shape (n,) or one number, in parts of the current scale (about\n"
    "    Isc). The sum of all currents must fall with the voltage.\n"
    "series : callable, optional\n"
    "    ``series(current, k, m, ...)``: the voltage of one cell, V, that is lost beside Rs at "
    "these\n"
    "    delivered currents, in parts of the current scale.\n"
    "junction_derivatives, series_derivatives : callable, optional\n"
    "    Called alike; a dict of arrays by name: ``'voltage'`` (or ``'current'``) and every\n"
    "    parameter's symbol, ``'photocurrent'`` and ``'thermal_voltage'`` where they are used.\n"
    "    Without it derivatives are differences of five values, in error by some 1e-12 of the "
    "value\n"
    "    where the function is smooth over 0.4 mV, and a fit calls the function six times as "
    "often.\n"
    "probes : list of sequences, optional\n"
    "    Full sets of parameters from which a fit or diagnosis tries it.\n\n"
    "Notes\n-----\n"
    "A function may ask for more by keyword-only arguments: ``photocurrent`` (array of shape "
    "(n,),\n"
    "parts of the current scale, of the cell under its light), ``thermal_voltage`` (array, V),\n"
    "``reach`` (largest abs(voltage) of the readings, V of a cell), ``cells`` (in series). It is\n"
    "called with pieces of the curve, many times, on a thread that is not the main one. NaN says\n"
    "that there is no value. An exception in it ends the work and is raised again.\n";

std::map<std::string, std::pair<double, double>> RangesOf(py::handle what) {
  std::map<std::string, std::pair<double, double>> ranges;
  if (what.is_none()) return ranges;
  if (!py::isinstance<py::dict>(what)) {
    Raise({"with_: expected {'k': value or (low, high)} beside an Effect, found " +
               py::repr(what).cast<std::string>(),
           {}});
  }
  for (const auto& [key, value] : py::reinterpret_borrow<py::dict>(what)) {
    const std::string name = TextOf("with_", key);
    const bool pair = (py::isinstance<py::tuple>(value) || py::isinstance<py::list>(value)) &&
                      py::len(value) == 2;
    if (pair) {
      const py::sequence ends = py::reinterpret_borrow<py::sequence>(value);
      ranges[name] = {NumberOf("with_", ends[0]), NumberOf("with_", ends[1])};
    } else {
      const double fixed = NumberOf("with_", value);
      ranges[name] = {fixed, fixed};
    }
  }
  return ranges;
}

bool IsOwn(py::handle value) { return py::isinstance<OwnEffect>(value); }

void AddOwn(py::handle effect, py::handle ranges, EffectsAsked* asked) {
  auto own = effect.cast<std::shared_ptr<OwnEffect>>();
  asked->uses.push_back({&own->effect(), RangesOf(ranges)});
  asked->own.push_back(std::move(own));
}

void AddEffects(py::handle value, EffectsAsked* asked) {
  const bool list = py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value);
  if (IsOwn(value)) {
    AddOwn(value, py::none(), asked);
  } else if (py::isinstance<py::dict>(value)) {
    for (const auto& [key, inner] : py::reinterpret_borrow<py::dict>(value)) {
      if (IsOwn(key)) {
        AddOwn(key, inner, asked);
        continue;
      }
      py::dict one;
      one[key] = inner;
      for (const std::string& text : TextsOf("with_", one)) AddEffects(py::str(text), asked);
    }
  } else if (list && py::len(value) == 2 && IsOwn(value[py::int_(0)]) &&
             !IsOwn(value[py::int_(1)]) && !py::isinstance<py::str>(value[py::int_(1)])) {
    AddOwn(value[py::int_(0)], value[py::int_(1)], asked);
  } else if (list) {
    for (const py::handle member : value) AddEffects(member, asked);
  } else {
    Expected<EffectUse> use = ReadEffectUse(TextOf("with_", value));
    if (!use) Raise({"with_: " + use.error().ToString(), {}});
    asked->uses.push_back(*std::move(use));
  }
}

py::list CatalogueOf() {
  py::list effects;
  for (const Effect* effect : Catalogue()) {
    py::dict row;
    row["id"] = effect->id;
    row["title"] = effect->title;
    row["where"] = ToText(effect->where);
    row["group"] = GroupOf(*effect);
    row["action"] = effect->action;
    row["fact_sheet"] = effect->fact_sheet;
    row["equation"] = effect->equation;
    row["sentence"] = effect->sentence;
    row["needs"] = effect->needs;
    row["reference"] = ReferenceText(effect->reference);
    py::list parameters;
    for (const EffectParameter& parameter : effect->parameters) parameters.append(parameter.symbol);
    row["parameters"] = parameters;
    effects.append(row);
  }
  return effects;
}

}  // namespace

Faults FaultsOf(const OwnEffects& own) {
  Faults faults;
  for (const auto& effect : own) faults.Add(effect->fault());
  return faults;
}

EffectsAsked EffectsOf(py::handle value) {
  EffectsAsked asked;
  AddEffects(value, &asked);
  return asked;
}

OwnEffects OwnEffectsOf(const std::string& keyword, py::handle value) {
  OwnEffects own;
  if (IsOwn(value)) return {value.cast<std::shared_ptr<OwnEffect>>()};
  for (const py::handle member : value) {
    if (!IsOwn(member)) {
      Raise({keyword + ": expected lyrefit.Effect, found " + py::repr(member).cast<std::string>(),
             {}});
    }
    own.push_back(member.cast<std::shared_ptr<OwnEffect>>());
  }
  return own;
}

void BindEffects(py::module_* module) {
  py::class_<OwnEffect, std::shared_ptr<OwnEffect>>(*module, "Effect", kEffectDoc)
      .def(py::init(&MakeOwnEffect), py::arg("id"), py::arg("parameters"))
      .def_property_readonly(
          "id", [](const OwnEffect& own) { return own.effect().id; }, "str")
      .def_property_readonly(
          "parameters",
          [](const OwnEffect& own) {
            py::list symbols;
            for (const EffectParameter& p : own.effect().parameters) symbols.append(p.symbol);
            return symbols;
          },
          "list of str: their symbols, the strength first.")
      .def("__repr__", [](const OwnEffect& own) {
        return std::string("<lyrefit.Effect '") + own.effect().id + "'>";
      });
  module->def("effects", &CatalogueOf,
              "effects()\n--\n\n"
              "The catalogue: a dict for every effect that diagnose() knows, with its id, title,\n"
              "where it belongs, equation, what shows it and the symbols of its parameters.");
}

}  // namespace lyrefit::python
