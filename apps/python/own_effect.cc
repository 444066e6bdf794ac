#include <pybind11/numpy.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <optional>

#include "bindings.h"
#include "effects.h"
#include "keywords.h"

namespace lyrefit::python {
namespace {

constexpr const char* kStageConditions[] = {"photocurrent", "thermal_voltage"};
constexpr const char* kContext[] = {"photocurrent", "thermal_voltage", "reach", "cells"};

bool Has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// A Python function as a stage. Arguments: x, then the parameters one by one, then the requested
// context by keyword.
struct StageFunction {
  std::string where;  // for errors: "Effect 'x': junction"
  py::object function;
  std::vector<std::string> context;  // requested names of kContext
};

// Determines the keywords of a function; raises an error if it cannot be called as a stage.
StageFunction Inspect(const std::string& where, const py::object& function, int parameters) {
  StageFunction stage{where, function, {}};
  if (PyCallable_Check(function.ptr()) == 0) Raise({where + ": expected a function", {}});
  const py::object inspect = py::module_::import("inspect");
  const py::object kinds = inspect.attr("Parameter");
  int positional = 0;
  bool any = false;
  for (const py::handle taken :
       inspect.attr("signature")(function).attr("parameters").attr("values")()) {
    const py::object kind = taken.attr("kind");
    const std::string name = taken.attr("name").cast<std::string>();
    if (kind.is(kinds.attr("VAR_POSITIONAL"))) {
      any = true;
    } else if (kind.is(kinds.attr("KEYWORD_ONLY"))) {
      const bool known = std::any_of(std::begin(kContext), std::end(kContext),
                                     [&](const char* one) { return name == one; });
      if (!known) {
        Raise({where + ": takes '" + name +
                   "' by keyword; there are photocurrent, thermal_voltage, reach and cells",
               {}});
      }
      stage.context.push_back(name);
    } else if (!kind.is(kinds.attr("VAR_KEYWORD"))) {
      ++positional;
    }
  }
  if (!any && positional != 1 + parameters) {
    Raise({where + ": takes " + std::to_string(positional) + " arguments, expected " +
               std::to_string(1 + parameters) + ": the array and each parameter",
           {}});
  }
  return stage;
}

py::array_t<double> LanesOf(const double* values, int count) {
  return py::array_t<double>(count, values);
}

py::object Called(const StageFunction& stage, const StageInput& input) {
  py::tuple arguments(1 + input.parameters);
  arguments[0] = LanesOf(input.x, input.count);
  for (int k = 0; k < input.parameters; ++k) arguments[1 + k] = py::float_(input.p[k]);
  py::dict context;
  for (const std::string& name : stage.context) {
    if (name == kContext[0]) context[name.c_str()] = LanesOf(input.photocurrent, input.count);
    if (name == kContext[1]) context[name.c_str()] = LanesOf(input.thermal_voltage, input.count);
    if (name == kContext[2]) context[name.c_str()] = py::float_(input.reach);
    if (name == kContext[3]) context[name.c_str()] = py::float_(input.cells);
  }
  return stage.function(*arguments, **context);
}

// Copies one number for all, or one for each.
void Fill(const std::string& where, py::handle given, int count, double* to) {
  const auto values = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(given);
  const bool complex =
      py::hasattr(given, "dtype") && given.attr("dtype").attr("kind").cast<std::string>() == "c";
  if (values && !complex && values.size() == 1) {
    std::fill(to, to + count, *values.data());
  } else if (values && !complex && values.ndim() == 1 && values.size() == count) {
    std::memcpy(to, values.data(), sizeof(double) * count);
  } else {
    PyErr_Clear();
    Raise({where + ": expected " + std::to_string(count) + " numbers for an array of " +
               std::to_string(count) + ", found " + py::repr(given).cast<std::string>(),
           {}});
  }
}

// Runs `call` with the interpreter's lock, unless an exception was raised before.
template <class Call>
bool Guarded(const std::shared_ptr<Fault>& fault, const Call& call) {
  if (fault->Happened()) return false;
  const py::gil_scoped_acquire acquired;
  try {
    call();
    return true;
  } catch (...) {
    fault->Keep();
    return false;
  }
}

// After an exception a stage returns 0, so that the evaluation ends quickly without further errors.
PlainValue ValueOf(std::shared_ptr<const StageFunction> stage, std::shared_ptr<Fault> fault) {
  return
      [stage = std::move(stage), fault = std::move(fault)](const StageInput& input, double* value) {
        const bool done =
            Guarded(fault, [&] { Fill(stage->where, Called(*stage, input), input.count, value); });
        if (!done) std::fill(value, value + input.count, 0.0);
      };
}

// Names under which derivatives() returns the derivatives of a stage.
struct Slopes {
  std::string x;  // "voltage"
  std::vector<std::string> parameters;
};

void FillSlopes(const StageFunction& stage, const Slopes& names, const StageInput& input,
                const StageOutput& output) {
  const py::object given = Called(stage, input);
  if (!py::isinstance<py::dict>(given)) {
    Raise({stage.where + ": expected a dict of derivatives by name, found " +
               py::repr(given).cast<std::string>(),
           {}});
  }
  const auto fill = [&](const std::string& name, bool needed, double* to) {
    const py::dict slopes = py::reinterpret_borrow<py::dict>(given);
    if (slopes.contains(name)) {
      Fill(stage.where + " by " + name, slopes[name.c_str()], input.count, to);
    } else if (needed) {
      Raise({stage.where + ": there is no derivative by '" + name + "'", {}});
    } else {
      std::fill(to, to + input.count, 0.0);
    }
  };
  fill(names.x, true, output.by_x);
  if (output.by_p == nullptr) return;
  fill(kStageConditions[0], false, output.by_photocurrent);
  fill(kStageConditions[1], false, output.by_thermal_voltage);
  for (std::size_t k = 0; k < names.parameters.size(); ++k) {
    fill(names.parameters[k], true, output.by_p + k * input.count);
  }
}

PlainStage WithSlopes(PlainValue value, std::shared_ptr<const StageFunction> slopes, Slopes names,
                      std::shared_ptr<Fault> fault) {
  return [=](const StageInput& input, const StageOutput& output) {
    value(input, output.value);
    if (output.by_x == nullptr) return;
    const bool done = Guarded(fault, [&] { FillSlopes(*slopes, names, input, output); });
    if (done) return;
    std::fill(output.by_x, output.by_x + input.count, 0.0);
    if (output.by_p == nullptr) return;
    for (double* to : {output.by_photocurrent, output.by_thermal_voltage}) {
      std::fill(to, to + input.count, 0.0);
    }
    std::fill(output.by_p, output.by_p + input.parameters * input.count, 0.0);
  };
}

// Keywords of Effect().
class EffectMaker {
 public:
  EffectMaker(const py::handle& id, const py::handle& parameters, const py::kwargs& given)
      : keywords_("Effect", given) {
    texts_.id = TextOf("id", id);
    ReadTexts();
    ReadParameters(parameters);
    effect_.plain_junction = Stage("junction", "junction_derivatives", "voltage");
    effect_.plain_series = Stage("series", "series_derivatives", "current");
    ReadProbes();
    keywords_.Finish();
    if (!effect_.HasStage()) Raise({Name() + ": it needs a junction or a series function", {}});
  }
  std::shared_ptr<OwnEffect> Make() {
    return std::make_shared<OwnEffect>(std::move(texts_), std::move(effect_), fault_);
  }

 private:
  std::string Name() const { return "Effect '" + texts_.id + "'"; }

  void ReadTexts() {
    texts_.title = texts_.id;
    const std::pair<const char*, std::string*> all[] = {
        {"title", &texts_.title},         {"equation", &texts_.equation},
        {"sentence", &texts_.sentence},   {"needs", &texts_.needs},
        {"acts", &texts_.acts},           {"separate_by", &texts_.separate_by},
        {"reference", &texts_.reference}, {"action", &texts_.action},
    };
    for (const auto& [name, text] : all) {
      if (const auto value = keywords_.Take(name)) *text = TextOf(name, *value);
    }
  }

  void ReadParameters(py::handle parameters) {
    if (!py::isinstance<py::dict>(parameters) || py::len(parameters) == 0) {
      Raise({Name() + ": expected parameters as {'k': (lower, upper), ...}", {}});
    }
    for (const auto& [symbol, what] : py::reinterpret_borrow<py::dict>(parameters)) {
      ReadParameter(TextOf("parameters", symbol), what);
    }
  }

  void ReadParameter(const std::string& symbol, py::handle what) {
    py::kwargs given;
    if (py::isinstance<py::dict>(what)) {
      given = py::kwargs(py::dict(py::reinterpret_borrow<py::dict>(what)));
    } else {
      given["bounds"] = what;
    }
    const std::string place = Name() + ", parameter '" + symbol + "'";
    Keywords keywords(place.c_str(), given);
    OwnEffect::Texts::OfParameter texts{symbol, symbol, "", ""};
    EffectParameter parameter;
    const auto bounds = keywords.Take("bounds");
    if (!bounds || !py::isinstance<py::sequence>(*bounds) || py::len(*bounds) != 2) {
      Raise({place + ": expected bounds as (lower, upper)", {}});
    }
    parameter.lower = NumberOf(place, (*bounds)[py::int_(0)]);
    parameter.upper = NumberOf(place, (*bounds)[py::int_(1)]);
    parameter.neutral = std::min(std::max(0.0, parameter.lower), parameter.upper);
    if (const auto start = keywords.Take("start")) parameter.neutral = NumberOf(place, *start);
    if (const auto name = keywords.Take("name")) texts.name = TextOf(place, *name);
    if (const auto unit = keywords.Take("unit")) texts.unit = TextOf(place, *unit);
    if (const auto doc = keywords.Take("doc")) texts.doc = TextOf(place, *doc);
    if (const auto power = keywords.Take("current_power")) {
      parameter.current = static_cast<int>(WholeOf(place, *power));
    }
    if (const auto power = keywords.Take("cells_power")) {
      parameter.cells = static_cast<int>(WholeOf(place, *power));
    }
    keywords.Finish();
    const bool sound = std::isfinite(parameter.lower) && std::isfinite(parameter.upper) &&
                       parameter.lower < parameter.upper && parameter.lower <= parameter.neutral &&
                       parameter.neutral <= parameter.upper;
    if (!sound) Raise({place + ": expected finite bounds around where it starts", {}});
    texts_.parameters.push_back(std::move(texts));
    effect_.parameters.push_back(parameter);
  }

  PlainStage Stage(const char* name, const char* derivatives, const char* x) {
    const auto value = keywords_.Take(name);
    const auto slopes = keywords_.Take(derivatives);
    if (!value) {
      if (slopes) Raise({Name() + ": " + derivatives + " without " + name, {}});
      return {};
    }
    const int parameters = effect_.size();
    auto stage = std::make_shared<StageFunction>(Inspect(Name() + ": " + name, *value, parameters));
    const bool under_conditions =
        Has(stage->context, kStageConditions[0]) || Has(stage->context, kStageConditions[1]);
    PlainValue plain = ValueOf(std::move(stage), fault_);
    if (!slopes) {
      std::vector<std::pair<double, double>> ranges;
      for (const EffectParameter& p : effect_.parameters) ranges.emplace_back(p.lower, p.upper);
      return WithDifferences(std::move(plain), std::move(ranges), under_conditions);
    }
    Slopes names{x, {}};
    for (const auto& parameter : texts_.parameters) names.parameters.push_back(parameter.symbol);
    return WithSlopes(
        std::move(plain),
        std::make_shared<StageFunction>(Inspect(Name() + ": " + derivatives, *slopes, parameters)),
        std::move(names), fault_);
  }

  // Parameter sets for first trials: as given, or a tenth of the range for the strength.
  void ReadProbes() {
    std::vector<Probe> probes;
    if (const auto given = keywords_.Take("probes")) {
      for (const py::handle set : *given) {
        Probe probe;
        for (const py::handle number : set) probe.push_back(NumberOf("probes", number));
        if (static_cast<int>(probe.size()) != effect_.size()) {
          Raise({Name() + ": probes: expected a number for each parameter", {}});
        }
        probes.push_back(std::move(probe));
      }
    } else {
      Probe probe;
      for (const EffectParameter& p : effect_.parameters) probe.push_back(p.neutral);
      const EffectParameter& strength = effect_.parameters.front();
      const double up = strength.upper - strength.neutral;
      const double down = strength.lower - strength.neutral;
      for (const double way : {0.02 * up, 0.2 * up, 0.02 * down}) {
        if (way == 0) continue;
        probe.front() = strength.neutral + way;
        probes.push_back(probe);
      }
    }
    effect_.probes = [probes](const DataTraits&) { return probes; };
  }

  Keywords keywords_;
  OwnEffect::Texts texts_;
  Effect effect_;
  std::shared_ptr<Fault> fault_ = std::make_shared<Fault>();
};

}  // namespace

OwnEffect::OwnEffect(Texts texts, Effect effect, std::shared_ptr<Fault> fault)
    : texts_(std::move(texts)), effect_(std::move(effect)), fault_(std::move(fault)) {
  effect_.id = texts_.id.c_str();
  effect_.title = texts_.title.c_str();
  effect_.equation = texts_.equation.c_str();
  effect_.reference = texts_.reference.c_str();
  effect_.sentence = texts_.sentence.c_str();
  effect_.needs = texts_.needs.c_str();
  effect_.acts = texts_.acts.c_str();
  effect_.separate_by = texts_.separate_by.c_str();
  effect_.action = texts_.action.c_str();
  for (std::size_t k = 0; k < texts_.parameters.size(); ++k) {
    EffectParameter& parameter = effect_.parameters[k];
    parameter.symbol = texts_.parameters[k].symbol.c_str();
    parameter.name = texts_.parameters[k].name.c_str();
    parameter.unit = texts_.parameters[k].unit.c_str();
    parameter.doc = texts_.parameters[k].doc.c_str();
  }
}

std::shared_ptr<OwnEffect> MakeOwnEffect(const py::handle& id, const py::handle& parameters,
                                         const py::kwargs& given) {
  return EffectMaker(id, parameters, given).Make();
}

}  // namespace lyrefit::python
