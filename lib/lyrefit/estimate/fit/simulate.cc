#include "lyrefit/estimate/fit/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/random.h"
#include "lyrefit/base/try.h"
#include "lyrefit/estimate/fit/prepare_fit.h"
#include "lyrefit/model/extended_set.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/model/two_junctions.h"

namespace lyrefit {
namespace {

constexpr double kBeyondOpenCircuit = 1.02;

std::string Symbols(const std::vector<ParameterInfo>& infos) {
  std::string list;
  for (const ParameterInfo& info : infos) {
    list += (list.empty() ? "" : ", ") + info.symbol;
  }
  return list;
}

// Error for values at which the device is no passive illuminated diode.
Expected<void> CheckValue(const ParameterInfo& info, double value) {
  if (info.symbol == "alpha" && std::isfinite(value)) return {};
  const bool shunt = info.kind == ParameterKind::kShunt;
  const bool perfect_shunt = shunt && std::isinf(value) && value > 0;
  const bool positive = shunt || info.symbol[0] == 'n';
  if (perfect_shunt || (std::isfinite(value) && (positive ? value > 0 : value >= 0))) return {};
  return Fail(fmt::format("expected {} {}, found {}", info.symbol,
                          positive ? "above 0" : "of at least 0", value));
}

Expected<std::vector<double>> ParameterVector(const std::vector<ParameterInfo>& infos,
                                              const std::map<std::string, double>& parameters) {
  std::vector<double> values(infos.size(), kUnknown);
  std::vector<bool> given(infos.size(), false);
  for (const auto& [name, value] : parameters) {
    const std::optional<int> index = FindParameter(infos, name);
    if (!index) {
      return Fail(fmt::format("the model has no parameter {}: expected {}", name, Symbols(infos)));
    }
    TRY(CheckValue(infos[*index], value));
    values[*index] = value;
    given[*index] = true;
  }
  for (std::size_t i = 0; i < infos.size(); ++i) {
    if (!given[i]) {
      return Fail(
          fmt::format("no value for {}: the model needs {}", infos[i].symbol, Symbols(infos)));
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
  const bool more = !options.with.empty() || options.layout != nullptr || options.shared;
  if (options.recombination && more) {
    return Fail("no effects and no strings of unlike cells beside PVsyst's recombination loss");
  }
  if (options.junctions != 1 && options.junctions != 2) {
    return Fail(fmt::format("expected 1 or 2 junctions, found {}", options.junctions));
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

// The stated voltages, or even steps to a little beyond open circuit, of `points`.
Expected<std::vector<double>> Voltages(const SimulateOptions& options, const KeyPoints& points) {
  if (!options.voltage_V.empty()) return options.voltage_V;
  const double voc = points.open_circuit_voltage_V;
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

// Effects with one value for each of their parameters.
Expected<std::vector<EffectUse>> SettledUses(const SimulateOptions& options) {
  std::vector<EffectUse> uses = options.with;
  for (EffectUse& use : uses) {
    const std::vector<EffectParameter>& infos = use.effect->parameters;
    for (const auto& [key, range] : use.ranges) {
      TRY(CheckParameter(use, key));
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

// Adds the effects to `device` and returns the parameters of both.
Expected<std::vector<double>> AddEffects(const SimulateOptions& options, const IvCurve& taken,
                                         std::vector<double> p, Device* device) {
  TRY(auto uses, SettledUses(options));
  TRY(*device, Extend(*device, options.model, options.constants, taken, uses, options.force_effects,
                      options.layout));
  const std::vector<double>& usual = device->effects->usual;
  p.insert(p.end(), usual.begin(), usual.end());
  return p;
}

Expected<void> CheckCurrents(const IvCurve& curve) {
  for (const double current : curve.current_A) {
    if (!std::isfinite(current)) return Fail("the device has no current there");
  }
  return {};
}

// Simulates one curve of a law of many curves.
Expected<IvCurve> SimulateShared(const SimulateOptions& options) {
  if (options.layout != nullptr) {
    return Fail("a law behind many curves has its own cells: strings are laid out of parameters");
  }
  SharedLaw shared = *options.shared;
  IvCurve& taken = shared.set.curves[shared.curve];
  taken.conditions = options.conditions;
  TRY(auto uses, SettledUses(options));
  Conditions reference = options.conditions;
  reference.cell_temperature_K = shared.reference_K;
  TRY(const Device device,
      ExtendSet(MakeDevice(options.model, reference, options.constants), shared.law, shared.set,
                shared.reference_K, uses, /*force=*/true));
  Device base = device;
  base.parameters.resize(device.effects->law.base_size());
  TRY(auto p, ParameterVector(base.parameters, options.parameters));
  p.insert(p.end(), device.effects->usual.begin(), device.effects->usual.end());
  const Device one = OfCurve(device, shared.curve);
  IvCurve curve = taken;
  curve.name = options.name;
  if (options.voltage_V.empty()) {
    curve.current_A = SolveCurrents(one, p.data(), MakePointSet(curve.voltage_V, curve.current_A));
  } else {
    curve = IvCurve();
    curve.name = options.name;
    curve.conditions = options.conditions;
    curve.notes = taken.notes;
    curve.voltage_V = options.voltage_V;
    curve.current_A = SolveCurrents(one, p.data(), curve.voltage_V);
  }
  TRY(CheckCurrents(curve));
  AddNoise(options, &curve);
  return curve;
}

// Simulates a tandem of two unlike junctions.
Expected<IvCurve> SimulateTwoJunctions(const SimulateOptions& options) {
  const bool more = !options.with.empty() || options.layout != nullptr || options.shared ||
                    options.recombination || options.model != Model::kSingleDiode;
  if (more) {
    return Fail("two junctions have one diode each, without effects or strings of unlike cells");
  }
  TRY(const auto p, ParameterVector(TwoJunctionInfos(), options.parameters));
  const double thermal_V = ThermalVoltage(options.conditions.cell_temperature_K, options.constants);
  IvCurve curve;
  curve.name = options.name;
  curve.conditions = options.conditions;
  curve.conditions.cells_in_series = 2;
  TRY(curve.voltage_V, Voltages(options, TwoJunctionKeyPoints(thermal_V, p.data())));
  for (const double voltage : curve.voltage_V) {
    curve.current_A.push_back(TwoJunctionCurrent(thermal_V, p.data(), voltage));
  }
  TRY(Validate(curve));
  TRY(CheckCurrents(curve));
  AddNoise(options, &curve);
  return curve;
}

}  // namespace

Expected<IvCurve> Simulate(const SimulateOptions& options) {
  TRY(CheckOptions(options));
  if (options.junctions == 2) return SimulateTwoJunctions(options);
  if (options.shared) return SimulateShared(options);
  Device device = MakeDevice(options.model, options.conditions, options.constants);
  if (options.recombination) AddRecombination(&device);
  Expected<std::vector<double>> parameters = ParameterVector(device.parameters, options.parameters);
  if (!parameters) return tl::unexpected(parameters.error());
  const bool as_taken = options.taken.has_value() && options.voltage_V.empty();
  Expected<std::vector<double>> voltages =
      as_taken ? options.taken->voltage_V
               : Voltages(options, ModelKeyPoints(device, parameters->data()));
  if (!voltages) return tl::unexpected(voltages.error());
  IvCurve curve;
  if (as_taken) curve = *options.taken;
  curve.name = options.name;
  curve.conditions = options.conditions;
  curve.voltage_V = std::move(*voltages);
  curve.current_A.assign(curve.voltage_V.size(), 0);
  TRY(Validate(curve));
  curve.current_A = SolveCurrents(device, parameters->data(), curve.voltage_V);
  if (!options.with.empty() || options.layout != nullptr) {
    parameters = AddEffects(options, options.taken.value_or(curve), *parameters, &device);
    if (!parameters) return tl::unexpected(parameters.error());
    const bool own = as_taken || !options.taken.has_value();
    curve.current_A = own ? SolveCurrents(device, parameters->data(),
                                          MakePointSet(curve.voltage_V, curve.current_A))
                          : SolveCurrents(device, parameters->data(), curve.voltage_V);
    TRY(CheckCurrents(curve));
  }
  AddNoise(options, &curve);
  return curve;
}

Expected<RmsePair> RmseOf(const IvCurve& curve, const std::map<std::string, double>& parameters,
                          ConstantSet constants) {
  TRY(Validate(curve));
  Device device;
  for (const Model model : {Model::kSingleDiode, Model::kDoubleDiode, Model::kTripleDiode}) {
    device = MakeDevice(model, curve.conditions, constants);
    const bool has_all =
        std::all_of(parameters.begin(), parameters.end(), [&](const auto& parameter) {
          return FindParameter(device.parameters, parameter.first).has_value();
        });
    if (has_all) break;
  }
  TRY(const auto p, ParameterVector(device.parameters, parameters));
  return BothRmse(device, p, curve);
}

}  // namespace lyrefit
