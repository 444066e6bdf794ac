#include "lyrefit/fit/simulate.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "lyrefit/base/file.h"
#include "lyrefit/base/random.h"
#include "lyrefit/base/version.h"
#include "lyrefit/curve/json_text.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/law/kernel.h"
#include "lyrefit/law/model_points.h"

namespace lyrefit {
namespace {

using nlohmann::json;

constexpr double kBeyondOpenCircuit = 1.02;
constexpr std::uintmax_t kLargestFitFile = 64U << 20;

std::string Symbols(const Device& device) {
  std::string list;
  for (const ParameterInfo& info : device.parameters) {
    list += (list.empty() ? "" : ", ") + info.symbol;
  }
  return list;
}

// Outside these ranges the device is no passive diode in the light.
Expected<void> CheckValue(const ParameterInfo& info, double value) {
  const bool perfect_shunt = info.symbol == "Rsh" && std::isinf(value) && value > 0;
  const bool positive = info.symbol == "Rsh" || info.symbol[0] == 'n';
  if (perfect_shunt || (std::isfinite(value) && (positive ? value > 0 : value >= 0))) return {};
  return Fail(fmt::format("expected {} {}, found {}", info.symbol,
                          positive ? "above 0" : "of at least 0", value));
}

Expected<std::vector<double>> ParameterVector(const Device& device,
                                              const std::map<std::string, double>& parameters) {
  std::vector<double> values(device.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<bool> given(device.size(), false);
  for (const auto& [name, value] : parameters) {
    const std::optional<int> index = device.Find(name);
    if (!index) {
      return Fail(fmt::format("the model has no parameter {}: expected {}", name, Symbols(device)));
    }
    if (auto checked = CheckValue(device.parameters[*index], value); !checked) {
      return tl::unexpected(checked.error());
    }
    values[*index] = value;
    given[*index] = true;
  }
  for (int i = 0; i < device.size(); ++i) {
    if (!given[i]) {
      return Fail(fmt::format("no value for {}: the model needs {}", device.parameters[i].symbol,
                              Symbols(device)));
    }
  }
  return values;
}

Expected<void> CheckOptions(const SimulateOptions& options) {
  const auto not_negative = [](double value) { return std::isfinite(value) && value >= 0; };
  if (!not_negative(options.noise_A)) {
    return Fail(fmt::format("expected a noise of at least 0 A, found {}", options.noise_A));
  }
  if (!not_negative(options.noise_relative)) {
    return Fail(
        fmt::format("expected a relative noise of at least 0, found {}", options.noise_relative));
  }
  if (options.voltage_V.empty() && (options.points < 2 || options.points > 10'000'000)) {
    return Fail(fmt::format("expected 2 to 10000000 points, found {}", options.points));
  }
  const Conditions& c = options.conditions;
  if (c.cells_in_series < 1 || !(c.cell_temperature_K > 0) ||
      !std::isfinite(c.cell_temperature_K)) {
    return Fail(
        fmt::format("expected at least 1 cell in series and a temperature above 0 K, found {} "
                    "and {:.6g} K",
                    c.cells_in_series, c.cell_temperature_K));
  }
  return {};
}

Expected<std::vector<double>> Voltages(const SimulateOptions& options, const Device& device,
                                       const std::vector<double>& p) {
  if (!options.voltage_V.empty()) return options.voltage_V;
  const double voc = ModelKeyPoints(device, p.data()).open_circuit_voltage_V;
  if (std::isnan(voc))
    return Fail("the device has no open-circuit voltage to end at: give the voltages");
  std::vector<double> voltage_V(options.points);
  for (int i = 0; i < options.points; ++i) {
    voltage_V[i] = kBeyondOpenCircuit * voc * i / (options.points - 1);
  }
  return voltage_V;
}

void AddNoise(const SimulateOptions& options, IvCurve* curve) {
  if (options.noise_A == 0 && options.noise_relative == 0) return;
  RandomStream random(options.seed);
  for (double& current : curve->current_A) {
    current += std::hypot(options.noise_A, options.noise_relative * current) * random.Normal();
  }
  curve->notes.current_noise_constant_A = options.noise_A;
  curve->notes.current_noise_relative = options.noise_relative;
}

// The value a fit answers with: refined, or searched where there was no polish.
Expected<double> AnsweredValue(const json& parameter, bool polished, const std::string& name,
                               const std::string& path) {
  const char* const key = polished ? "refined" : "searched";
  const json value = parameter.is_object() ? parameter.value(key, json()) : json();
  if (value.is_number()) return value.get<double>();
  if (value.is_null() && name == "resistance_shunt" && parameter.is_object()) {
    return std::numeric_limits<double>::infinity();
  }
  return Fail(fmt::format("expected a number in parameters.{}.{}", name, key), path);
}

// What stands at `pointer`, null where nothing does.
json At(const json& document, const char* pointer) {
  const json::json_pointer place(pointer);
  return document.contains(place) ? document.at(place) : json();
}

Expected<void> ReadConditions(const json& fit, const std::string& text, const std::string& path,
                              Conditions* conditions) {
  const json object = At(fit, "/curve/conditions");
  if (!object.is_object()) return Fail("expected an object in curve.conditions", path);
  const JsonFields fields(object, text, path);
  const auto cells = fields.WholeNumber({"cells_in_series"});
  if (!cells) return tl::unexpected(cells.error());
  const auto strings = fields.WholeNumber({"strings_in_parallel"});
  if (!strings) return tl::unexpected(strings.error());
  const auto temperature_C = fields.Number({"cell_temperature_C"});
  if (!temperature_C) return tl::unexpected(temperature_C.error());
  const auto irradiance = fields.Number({"irradiance_Wm2"});
  if (!irradiance) return tl::unexpected(irradiance.error());
  if (!*cells || !*temperature_C) {
    return Fail("expected cells_in_series and cell_temperature_C in curve.conditions", path);
  }
  conditions->cells_in_series = **cells;
  conditions->strings_in_parallel = strings->value_or(1);
  conditions->cell_temperature_K = **temperature_C + kZeroCelsius_K;
  conditions->irradiance_W_m2 = irradiance->value_or(1000);
  return {};
}

}  // namespace

namespace {

// Every parameter of every effect at one value.
Expected<std::vector<EffectUse>> SettledUses(const SimulateOptions& options) {
  std::vector<EffectUse> uses = options.with;
  for (EffectUse& use : uses) {
    const std::vector<EffectParameter>& infos = use.effect->parameters;
    for (const auto& [key, range] : use.ranges) {
      if (auto known = CheckParameter(use, key); !known) return tl::unexpected(known.error());
      if (range.first == range.second) continue;
      return Fail(fmt::format("{}: a simulation needs one value of {}, found {:g}:{:g}",
                              use.effect->id, key, range.first, range.second));
    }
    const auto given = [&](const EffectParameter& info) {
      return use.ranges.count(info.symbol) + use.ranges.count(info.name) > 0;
    };
    if (!infos.empty() && !given(infos.front())) {
      return Fail(fmt::format("{}: a simulation needs its strength, {} ({})", use.effect->id,
                              infos.front().symbol, infos.front().doc));
    }
  }
  return uses;
}

// The device with its effects, and the parameters of both.
Expected<std::vector<double>> AddEffects(const SimulateOptions& options, const IvCurve& taken,
                                         std::vector<double> p, Device* device) {
  auto uses = SettledUses(options);
  if (!uses) return tl::unexpected(uses.error());
  auto extended =
      Extend(*device, options.model, options.constants, taken, *uses, options.force_effects,
             options.layout);
  if (!extended) return tl::unexpected(extended.error());
  *device = std::move(*extended);
  const std::vector<double>& usual = device->extension->usual;
  p.insert(p.end(), usual.begin(), usual.end());
  return p;
}

}  // namespace

Expected<IvCurve> Simulate(const SimulateOptions& options) {
  if (auto checked = CheckOptions(options); !checked) return tl::unexpected(checked.error());
  Device device = MakeDevice(options.model, options.conditions, options.constants);
  Expected<std::vector<double>> parameters = ParameterVector(device, options.parameters);
  if (!parameters) return tl::unexpected(parameters.error());
  const bool as_taken = options.taken.has_value() && options.voltage_V.empty();
  Expected<std::vector<double>> voltages =
      as_taken ? options.taken->voltage_V : Voltages(options, device, *parameters);
  if (!voltages) return tl::unexpected(voltages.error());
  IvCurve curve;
  if (as_taken) curve = *options.taken;
  curve.name = options.name;
  curve.conditions = options.conditions;
  curve.voltage_V = std::move(*voltages);
  curve.current_A.assign(curve.voltage_V.size(), 0);
  if (auto valid = Validate(curve); !valid) return tl::unexpected(valid.error());
  curve.current_A = SolveCurrents(device, parameters->data(), curve.voltage_V);
  if (!options.with.empty() || options.layout != nullptr) {
    parameters = AddEffects(options, options.taken.value_or(curve), *parameters, &device);
    if (!parameters) return tl::unexpected(parameters.error());
    const bool own = as_taken || !options.taken.has_value();
    curve.current_A = own ? SolveCurrents(device, parameters->data(),
                                          MakePointSet(curve.voltage_V, curve.current_A))
                          : SolveCurrents(device, parameters->data(), curve.voltage_V);
    for (const double current : curve.current_A) {
      if (!std::isfinite(current)) return Fail("the device has no current there");
    }
  }
  AddNoise(options, &curve);
  return curve;
}

namespace {

// A model of many curves is more than its one curve.
Expected<void> RefuseMany(const json& fit, const std::string& path) {
  const json curves = At(fit, "/curves");
  if (curves.is_number() && curves.get<double>() > 1) {
    return Fail("a model of " + curves.dump() +
                    " curves under conditions of their own, which cannot be simulated yet: "
                    "expected a report of one curve",
                path);
  }
  return {};
}

std::vector<double> NumbersAt(const json& document, const char* pointer) {
  std::vector<double> values;
  for (const json& value : At(document, pointer)) {
    values.push_back(value.is_number() ? value.get<double>()
                                       : std::numeric_limits<double>::quiet_NaN());
  }
  return values;
}

// Effects with the values the report answers with, and the measurement they act in.
Expected<void> ReadEffects(const json& fit, bool polished, const std::string& path,
                           SimulateOptions* options) {
  const json causes = At(fit, "/causes");
  if (!causes.is_array() || causes.empty()) return {};
  const json version = At(fit, "/lyrefit_version");
  if (version != Version() || !At(fit, "/law").is_object()) {
    return Fail(
        fmt::format("a model with effects, written by lyrefit {}, which this one ({}) does "
                    "not read: fit it again",
                    version.is_string() ? version.get<std::string>() : "of no version", Version()),
        path);
  }
  for (const json& cause : causes) {
    EffectUse use;
    use.effect = cause.is_string() ? FindEffect(cause.get<std::string>()) : nullptr;
    if (use.effect == nullptr) return Fail("there is no effect " + cause.dump(), path);
    for (const EffectParameter& info : use.effect->parameters) {
      const std::string name = fmt::format("{}_{}", use.effect->id, info.name);
      const auto value =
          AnsweredValue(At(fit, "/parameters").value(name, json()), polished, name, path);
      if (!value) return tl::unexpected(value.error());
      use.ranges[info.symbol] = {*value, *value};
    }
    options->with.push_back(std::move(use));
  }
  IvCurve taken;
  taken.name = options->name;
  taken.conditions = options->conditions;
  taken.irradiance_known = true;
  taken.voltage_V = NumbersAt(fit, "/data/voltage_V");
  taken.current_A = NumbersAt(fit, "/data/current_A");
  taken.time_s = NumbersAt(fit, "/law/time_s");
  taken.irradiance_W_m2 = NumbersAt(fit, "/law/irradiance_Wm2");
  const json bypass = At(fit, "/law/bypass_diodes");
  if (bypass.is_number_integer()) taken.notes.bypass_diodes = bypass.get<int>();
  if (auto valid = Validate(taken); !valid) return Fail(valid.error().message, path);
  options->taken = std::move(taken);
  options->force_effects = true;  // they were fitted to it
  return {};
}

}  // namespace

Expected<SimulateOptions> ReadFitForSimulation(const std::string& path) {
  const Expected<std::string> text = ReadTextFile(path, kLargestFitFile);
  if (!text) return tl::unexpected(text.error());
  const Expected<json> fit = ParseJson(*text, path);
  if (!fit) return tl::unexpected(fit.error());
  const auto text_of = [&](const char* key) {
    const json value = At(*fit, key);
    return value.is_string() ? value.get<std::string>() : std::string();
  };
  const std::optional<Model> model = FromText<Model>(text_of("/model"));
  const std::optional<ConstantSet> constants = FromText<ConstantSet>(text_of("/constants"));
  const json parameters = At(*fit, "/parameters");
  if (!model || !constants || !parameters.is_object()) {
    return Fail("expected a fit report as lyrefit writes it: model, constants, parameters", path);
  }
  if (auto one = RefuseMany(*fit, path); !one) return tl::unexpected(one.error());
  SimulateOptions options;
  options.model = *model;
  options.constants = *constants;
  if (auto read = ReadConditions(*fit, *text, path, &options.conditions); !read) {
    return tl::unexpected(read.error());
  }
  if (auto checked = CheckOptions(options); !checked) return Fail(checked.error().message, path);
  const bool polished = At(*fit, "/rmse/refined/solved_current_A").is_number();
  for (const ParameterInfo& info : MakeDevice(*model, options.conditions).parameters) {
    const Expected<double> value =
        AnsweredValue(parameters.value(info.name, json()), polished, info.name, path);
    if (!value) return tl::unexpected(value.error());
    options.parameters[info.symbol] = *value;
  }
  if (auto read = ReadEffects(*fit, polished, path, &options); !read) {
    return tl::unexpected(read.error());
  }
  return options;
}

}  // namespace lyrefit
