#include "lyrefit/fit/simulate.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "lyrefit/base/file.h"
#include "lyrefit/base/random.h"
#include "lyrefit/curve/json_text.h"
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

Expected<IvCurve> Simulate(const SimulateOptions& options) {
  if (auto checked = CheckOptions(options); !checked) return tl::unexpected(checked.error());
  const Device device = MakeDevice(options.model, options.conditions, options.constants);
  const Expected<std::vector<double>> parameters = ParameterVector(device, options.parameters);
  if (!parameters) return tl::unexpected(parameters.error());
  Expected<std::vector<double>> voltages = Voltages(options, device, *parameters);
  if (!voltages) return tl::unexpected(voltages.error());
  IvCurve curve;
  curve.name = options.name;
  curve.conditions = options.conditions;
  curve.voltage_V = std::move(*voltages);
  curve.current_A.assign(curve.voltage_V.size(), 0);
  if (auto valid = Validate(curve); !valid) return tl::unexpected(valid.error());
  curve.current_A = SolveCurrents(device, parameters->data(), curve.voltage_V);
  AddNoise(options, &curve);
  return curve;
}

// An extended model is more than its diodes and its one curve.
Expected<void> RefuseExtended(const json& fit, const std::string& path) {
  const json causes = At(fit, "/causes");
  std::string names;
  for (const json& cause : causes) {
    if (cause.is_string()) names += (names.empty() ? "" : ", ") + cause.get<std::string>();
  }
  if (!names.empty()) {
    return Fail("a model extended by " + names +
                    ", which cannot be simulated yet: expected a report of lyrefit fit",
                path);
  }
  const json curves = At(fit, "/curves");
  if (curves.is_number() && curves.get<double>() > 1) {
    return Fail("a model of " + curves.dump() +
                    " curves under conditions of their own, which cannot be simulated yet: "
                    "expected a report of lyrefit fit of one curve",
                path);
  }
  return {};
}

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
  if (auto plain = RefuseExtended(*fit, path); !plain) return tl::unexpected(plain.error());
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
  return options;
}

}  // namespace lyrefit
