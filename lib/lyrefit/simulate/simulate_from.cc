#include "lyrefit/simulate/simulate_from.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "lyrefit/base/file.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/model/two_junctions.h"
#include "lyrefit/read/json_text.h"

namespace lyrefit {
namespace {

using nlohmann::json;

constexpr std::uintmax_t kLargestFitFile = 64U << 20;

struct Report {
  json fit;
  std::string text;
  std::string path;
  std::string curve;  // id of the requested curve; empty: the only one
};

// Value at `pointer`, null if there is none.
json At(const json& document, const std::string& pointer) {
  const json::json_pointer place(pointer);
  return document.contains(place) ? document.at(place) : json();
}

std::string TextAt(const json& document, const std::string& pointer) {
  const json value = At(document, pointer);
  return value.is_string() ? value.get<std::string>() : std::string();
}

double NumberOr(const json& document, const std::string& pointer, double usual) {
  const json value = At(document, pointer);
  return value.is_number() ? value.get<double>() : usual;
}

std::vector<double> NumbersAt(const json& document, const std::string& pointer) {
  std::vector<double> values;
  for (const json& value : At(document, pointer)) {
    values.push_back(value.is_number() ? value.get<double>() : kUnknown);
  }
  return values;
}

// Number at `pointer`; null is read as an infinite shunt resistance, which JSON cannot represent.
Expected<double> ValueAt(const json& document, const std::string& pointer, const std::string& name,
                         const std::string& path) {
  const json value = At(document, pointer);
  if (value.is_number()) return value.get<double>();
  const bool shunt = name.rfind("resistance_shunt", 0) == 0 || name == "R_sh_ref";
  const bool there = document.contains(json::json_pointer(pointer));
  if (shunt && there && value.is_null()) return kInfinity;
  return Fail("expected a number in " + pointer.substr(1), path);
}

// Value of a parameter in a fit: refined, or searched if there was no polish.
Expected<double> AnsweredValue(const Report& report, const std::string& name) {
  const bool polished = At(report.fit, "/rmse/refined/solved_current_A").is_number();
  return ValueAt(report.fit, "/parameters/" + name + (polished ? "/refined" : "/searched"), name,
                 report.path);
}

Expected<void> ReadConditions(const Report& report, Conditions* conditions) {
  const json object = At(report.fit, "/curve/conditions");
  if (!object.is_object()) return Fail("expected an object in curve.conditions", report.path);
  const JsonFields fields(object, report.text, report.path);
  TRY(const auto cells, fields.WholeNumber({"cells_in_series"}));
  TRY(const auto strings, fields.WholeNumber({"strings_in_parallel"}));
  TRY(const auto temperature_C, fields.Number({"cell_temperature_C"}));
  TRY(const auto irradiance, fields.Number({"irradiance_Wm2"}));
  if (!cells || !temperature_C) {
    return Fail("expected cells_in_series and cell_temperature_C in curve.conditions", report.path);
  }
  conditions->cells_in_series = *cells;
  conditions->strings_in_parallel = strings.value_or(1);
  conditions->cell_temperature_K = *temperature_C + kZeroCelsius_K;
  conditions->irradiance_W_m2 = irradiance.value_or(1000);
  return {};
}

// "1" of "1.2.0": reports of one major version keep the names and the meanings of their fields.
std::string MajorVersion(const std::string& version) {
  return version.substr(0, version.find('.'));
}

// Effects with their values; `value` returns the value of a parameter by name.
template <class F>
Expected<std::vector<EffectUse>> ReadUses(const Report& report, const F& value) {
  std::vector<EffectUse> uses;
  const json causes = At(report.fit, "/causes");
  if (!causes.is_array() || causes.empty()) return uses;
  const std::string version = TextAt(report.fit, "/lyrefit_version");
  if (MajorVersion(version) != MajorVersion(Version()) || !At(report.fit, "/law").is_object()) {
    return Fail(fmt::format("a model with effects, written by lyrefit {}, which this one ({}) does "
                            "not read: fit it again",
                            version.empty() ? "of no version" : version, Version()),
                report.path);
  }
  for (const json& cause : causes) {
    EffectUse use;
    use.effect = cause.is_string() ? FindEffect(cause.get<std::string>()) : nullptr;
    if (use.effect == nullptr) return Fail("there is no effect " + OneLine(cause), report.path);
    for (const EffectParameter& info : use.effect->parameters) {
      const Expected<double> found = value(fmt::format("{}.{}", use.effect->id, info.symbol));
      if (!found) {
        return Fail(found.error().message + " (if an earlier lyrefit wrote it: fit it again)",
                    report.path);
      }
      use.ranges[info.symbol] = {*found, *found};
    }
    uses.push_back(std::move(use));
  }
  return uses;
}

void TakeBypassDiodes(const Report& report, IvCurve* curve) {
  const json bypass = At(report.fit, "/law/bypass_diodes");
  if (bypass.is_number_integer()) curve->notes.bypass_diodes = bypass.get<int>();
}

// Reads a report of one curve.
Expected<void> ReadOne(const Report& report, SimulateOptions* options) {
  const json curves = At(report.fit, "/curves");
  if (curves.is_number() && curves.get<double>() > 1) {
    return Fail("a model of " + OneLine(curves) +
                    " curves whose measurement the report does not hold: expected one with effects",
                report.path);
  }
  if (!report.curve.empty()) {
    return Fail(
        fmt::format("a report of one curve, in which there is no curve {} to choose", report.curve),
        report.path);
  }
  TRY(ReadConditions(report, &options->conditions));
  for (const ParameterInfo& info : MakeDevice(options->model, options->conditions).parameters) {
    TRY(const auto value, AnsweredValue(report, info.name));
    options->parameters[info.symbol] = value;
  }
  const auto answered = [&](const std::string& name) { return AnsweredValue(report, name); };
  TRY(auto uses, ReadUses(report, answered));
  if (uses.empty()) return {};
  options->with = std::move(uses);
  IvCurve taken;
  taken.name = options->name;
  taken.conditions = options->conditions;
  taken.irradiance_known = true;
  taken.voltage_V = NumbersAt(report.fit, "/data/voltage_V");
  taken.current_A = NumbersAt(report.fit, "/data/current_A");
  taken.time_s = NumbersAt(report.fit, "/law/time_s");
  taken.irradiance_W_m2 = NumbersAt(report.fit, "/law/irradiance_Wm2");
  TakeBypassDiodes(report, &taken);
  if (auto valid = Validate(taken); !valid) return Fail(valid.error().message, report.path);
  options->taken = std::move(taken);
  options->force_effects = true;  // they were fitted to these readings
  return {};
}

// Index of the requested curve among those of a report.
Expected<int> Chosen(const Report& report, const json& curves) {
  constexpr std::size_t kNamed = 12;
  std::string ids;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const std::string id = TextAt(curves[c], "/id");
    if (id == report.curve || (report.curve.empty() && curves.size() == 1)) {
      return static_cast<int>(c);
    }
    if (c < kNamed) ids += (ids.empty() ? "" : ", ") + id;
    if (c == kNamed) ids += ", ...";
  }
  if (report.curve.empty()) {
    return Fail(fmt::format("a report of {} curves: choose one of {}", curves.size(), ids),
                report.path);
  }
  return Fail(fmt::format("there is no curve {}, expected one of {}", report.curve, ids),
              report.path);
}

Expected<CurveSet> ReadTaken(const Report& report) {
  CurveSet set;
  for (const json& one : At(report.fit, "/law/curves")) {
    IvCurve curve;
    curve.name = TextAt(one, "/id");
    curve.conditions.cells_in_series =
        static_cast<int>(NumberOr(report.fit, "/law/cells_in_series", 0));
    curve.conditions.strings_in_parallel =
        static_cast<int>(NumberOr(report.fit, "/law/strings_in_parallel", 1));
    curve.conditions.irradiance_W_m2 = NumberOr(one, "/irradiance_Wm2", 1000);
    curve.conditions.cell_temperature_K = NumberOr(one, "/cell_temperature_C", 25) + kZeroCelsius_K;
    curve.voltage_V = NumbersAt(one, "/voltage_V");
    curve.current_A = NumbersAt(one, "/current_A");
    curve.time_s = NumbersAt(one, "/time_s");
    curve.irradiance_W_m2 = NumbersAt(one, "/reading_irradiance_Wm2");
    TakeBypassDiodes(report, &curve);
    if (auto valid = Validate(curve); !valid) return Fail(valid.error().message, report.path);
    set.curves.push_back(std::move(curve));
  }
  return set;
}

// Reads one law of many curves, with effects.
Expected<void> ReadShared(const Report& report, SimulateOptions* options) {
  TRY(const auto chosen, Chosen(report, At(report.fit, "/law/curves")));
  TRY(auto set, ReadTaken(report));
  const json parameters = At(report.fit, "/parameters");
  for (const auto& [name, parameter] : parameters.items()) {
    const std::string symbol = TextAt(parameter, "/symbol");
    if (parameter.contains("effect") || symbol == "dEg") continue;  // base parameters only
    TRY(const auto value, AnsweredValue(report, name));
    options->parameters[symbol] = value;
  }
  const auto answered = [&](const std::string& name) { return AnsweredValue(report, name); };
  TRY(auto uses, ReadUses(report, answered));
  options->with = std::move(uses);
  options->conditions = set.curves[chosen].conditions;
  SharedLaw shared;
  shared.law.model = options->model;
  shared.law.constants = options->constants;
  shared.law.shunt =
      FromText<ShuntLaw>(TextAt(report.fit, "/law/shunt")).value_or(ShuntLaw::kConstant);
  shared.law.bandgap_slope_per_K = NumberOr(report.fit, "/law/bandgap_slope_per_K", 0);
  shared.reference_K = NumberOr(report.fit, "/law/reference_temperature_C", 25) + kZeroCelsius_K;
  shared.set = std::move(set);
  shared.curve = chosen;
  options->shared = std::move(shared);
  return {};
}

// Reads one curve of a family by its own parameters: those from the law, or those of an individual
// fit.
Expected<void> ReadMember(const Report& report, SimulateOptions* options) {
  const json curves = At(report.fit, "/curves");
  TRY(const auto chosen, Chosen(report, curves));
  const json& curve = curves[chosen];
  if (TextAt(curve, "/role") == "left-out") {
    return Fail(fmt::format("curve {} was left out: {}", report.curve, TextAt(curve, "/reason")),
                report.path);
  }
  // From the law; else of the curve alone, whose key was "free_parameters" in version 0.1.
  const std::string stretch = At(curve, "/parameters").is_object() ? "/parameters/"
                              : At(curve, "/individual_parameters").is_object()
                                  ? "/individual_parameters/"
                                  : "/free_parameters/";
  const auto value = [&](const std::string& name) {
    return ValueAt(curve, stretch + name, name, report.path);
  };
  const auto with_offsets = [&](const char* stated, const std::string& offset) {
    return NumberOr(curve, stated, std::nan("")) + NumberOr(curve, "/" + offset + "/value", 0);
  };
  Conditions& at = options->conditions;
  at.cells_in_series = static_cast<int>(NumberOr(report.fit, "/cells_in_series", 0));
  at.cell_temperature_K = with_offsets("/temperature_C", "temperature_offset_K") +
                          NumberOr(report.fit, "/sensor_offsets/temperature_K/value", 0) +
                          kZeroCelsius_K;
  at.irradiance_W_m2 = with_offsets("/irradiance_Wm2", "irradiance_offset_Wm2") +
                       NumberOr(report.fit, "/sensor_offsets/irradiance_Wm2/value", 0);
  for (const ParameterInfo& info : MakeDevice(options->model, {}).parameters) {
    TRY(const auto found, value(info.name));
    options->parameters[info.symbol] = found;
  }
  TRY(auto uses, ReadUses(report, value));
  if (uses.empty()) return {};
  options->with = std::move(uses);
  TRY(auto set, ReadTaken(report));
  for (IvCurve& one : set.curves) {
    if (one.name == TextAt(curve, "/id")) options->taken = std::move(one);
  }
  options->force_effects = true;  // they were fitted to these readings
  return {};
}

// Reads one curve of a fit of two junctions, by the parameters in its light.
Expected<SimulateOptions> ReadTwoJunctions(const Report& report) {
  const std::optional<ConstantSet> constants =
      FromText<ConstantSet>(TextAt(report.fit, "/constants"));
  if (!constants) return Fail("expected a fit report as lyrefit writes it: constants", report.path);
  SimulateOptions options;
  options.junctions = 2;
  options.constants = *constants;
  const json curves = At(report.fit, "/curves");
  TRY(const auto chosen, Chosen(report, curves));
  for (const ParameterInfo& info : TwoJunctionInfos()) {
    TRY(const auto value,
        ValueAt(curves[chosen], "/parameters/" + info.name, info.name, report.path));
    options.parameters[info.symbol] = value;
  }
  Conditions& at = options.conditions;
  at.cells_in_series = 2;
  at.cell_temperature_K = NumberOr(report.fit, "/cell_temperature_C", 25) + kZeroCelsius_K;
  at.irradiance_W_m2 = NumberOr(curves[chosen], "/curve/conditions/irradiance_Wm2", 1000);
  return options;
}

}  // namespace

Expected<SimulateOptions> ReadFitForSimulation(const std::string& path, const std::string& curve) {
  TRY(const auto text, ReadTextFile(path, kLargestFitFile));
  return ReadFitTextForSimulation(text, path, curve);
}

Expected<SimulateOptions> ReadFitTextForSimulation(const std::string& text, const std::string& path,
                                                   const std::string& curve) {
  TRY(auto fit, ParseJson(text, path));
  const Report report{std::move(fit), text, path, curve};
  if (At(report.fit, "/junctions") == 2) return ReadTwoJunctions(report);
  const std::optional<Model> model = FromText<Model>(TextAt(report.fit, "/model"));
  const std::optional<ConstantSet> constants =
      FromText<ConstantSet>(TextAt(report.fit, "/constants"));
  if (!model || !constants || !At(report.fit, "/parameters").is_object()) {
    return Fail("expected a fit report as lyrefit writes it: model, constants, parameters", path);
  }
  SimulateOptions options;
  options.model = *model;
  options.constants = *constants;
  const bool shared = At(report.fit, "/law/reference_temperature_C").is_number();
  const bool many = At(report.fit, "/curves").is_array();
  TRY(shared ? ReadShared(report, &options)
      : many ? ReadMember(report, &options)
             : ReadOne(report, &options));
  return options;
}

}  // namespace lyrefit
