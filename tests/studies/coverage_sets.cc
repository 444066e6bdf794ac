#include "studies/coverage_sets.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "lyrefit/base/random.h"
#include "lyrefit/model/default_values.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/model/model_points.h"
#include "synthetic/draw.h"

namespace lyrefit {
namespace {

// Irradiance in W/m2 and temperature in C of IEC 61853-1:2011, Table 2. The first five span the
// table.
constexpr std::pair<double, double> kGrid[] = {
    {1000, 25}, {1000, 75}, {200, 25}, {600, 50}, {100, 15}, {1100, 25}, {1100, 50}, {1100, 75},
    {1000, 15}, {1000, 50}, {800, 15}, {800, 25}, {800, 50}, {800, 75},  {600, 15},  {600, 25},
    {600, 75},  {400, 15},  {400, 25}, {400, 50}, {200, 15}, {100, 25}};
constexpr int kGridSize = static_cast<int>(std::size(kGrid));
constexpr int kSpanning = 5;
constexpr int kFewestCurves = 5;
constexpr int kMostSetCurves = 30;

// Draws a module. With `known_bandgap` it has the band gap of silicon, since a fit of temperature
// offsets assumes that value.
std::vector<double> DrawModule(const Translation& t, bool known_bandgap, RandomStream* random) {
  std::vector<double> p(t.parameters.size(), 0);
  const double isc = Between(random, 3, 10);
  const double voc = t.spec.cells_in_series * Between(random, 0.55, 0.70);
  const double n = Between(random, 1.0, t.n_2 >= 0 ? 1.2 : 1.4);
  const double rs = Between(random, 0.005, 0.03) * voc / isc;
  const double rsh = LogUniform(random, 20, 500) * voc / isc;
  p[t.n] = n;
  p[t.resistance_series] = rs;
  p[t.resistance_shunt] = rsh;
  p[t.alpha_sc] = Between(random, 2e-4, 8e-4) * isc;
  p[t.photocurrent] = isc * (1 + rs / rsh);  // the diode current at 0 V is negligible
  const bool pvsyst = t.spec.law == TranslationLaw::kPvsyst;
  const double bandgap_eV = Between(random, 1.10, 1.14);
  p[t.bandgap] = pvsyst || known_bandgap ? kDefaultBandgap_eV : bandgap_eV;
  if (t.bandgap_slope >= 0) p[t.bandgap_slope] = kDefaultBandgapSlope_per_K;
  if (t.n_slope >= 0) p[t.n_slope] = Between(random, -1e-3, 1e-3);
  if (t.resistance_shunt_dark >= 0) p[t.resistance_shunt_dark] = Between(random, 2, 8) * rsh;
  if (t.shunt_exponent >= 0) p[t.shunt_exponent] = kDefaultShuntExponent;
  const double diodes_A = p[t.photocurrent] - voc / rsh;
  const double second = t.n_2 >= 0 ? Between(random, 0.02, 0.5) : 0;
  const double thermal_V = t.device.module_thermal_voltage_V;
  p[t.saturation_current] = SaturationCurrent((1 - second) * diodes_A, voc, n * thermal_V);
  if (t.n_2 >= 0) {
    p[t.n_2] = kDefaultIdeality2;
    p[t.saturation_current_2] =
        SaturationCurrent(second * diodes_A, voc, kDefaultIdeality2 * thermal_V);
  }
  return p;
}

Expected<std::vector<double>> StatedModule(const Translation& t, const CoverageOptions& options) {
  std::vector<double> p(t.parameters.size(), kUnknown);
  for (const auto& [name, value] : options.module) {
    const std::optional<int> at = t.Find(name);
    if (!at) return Fail(fmt::format("the module: the law has no parameter {}", name));
    if (!std::isfinite(value)) return Fail(fmt::format("the module: {} is not finite", name));
    p[*at] = value;
  }
  const auto hold = [&](int at, double value) {
    if (at >= 0 && std::isnan(p[at])) p[at] = value;
  };
  if (t.spec.law == TranslationLaw::kPvsyst) hold(t.bandgap, kDefaultBandgap_eV);
  hold(t.bandgap_slope, kDefaultBandgapSlope_per_K);
  hold(t.shunt_exponent, kDefaultShuntExponent);
  hold(t.n_2, kDefaultIdeality2);
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!std::isnan(p[i])) continue;
    return Fail(fmt::format("the module: no value for {}", t.parameters[i].symbol));
  }
  return p;
}

// The true conditions of a set.
std::vector<std::pair<double, double>> DrawConditions(int count, RandomStream* random) {
  std::vector<std::pair<double, double>> grid(std::begin(kGrid), std::end(kGrid));
  for (int i = kGridSize - 1; i > kSpanning; --i) {
    const int other = kSpanning + static_cast<int>(random->Index(i - kSpanning + 1));
    std::swap(grid[i], grid[other]);
  }
  std::vector<std::pair<double, double>> conditions;
  conditions.reserve(count);
  for (int c = 0; c < count; ++c) conditions.push_back(grid[c % kGridSize]);
  return conditions;
}

Expected<KeyPoints> PointsAt(const SimulatedSet& made, double irradiance_W_m2,
                             double temperature_C) {
  const TranslatedDevice module =
      TranslateTo(made.translation, made.truth, irradiance_W_m2, temperature_C + kZeroCelsius_K);
  const KeyPoints points = ModelKeyPoints(module.device, module.parameters.data());
  if (points.open_circuit_voltage_V > 0 && points.short_circuit_current_A > 0) return points;
  return Fail(fmt::format("the module has no open-circuit voltage at {:g} W/m2 and {:g} C",
                          irradiance_W_m2, temperature_C));
}

// Adds noise to currents at even voltage steps up to Voc. `share`: the curve's Isc relative to Isc
// at the reference conditions.
void AddNoise(const CoverageOptions& options, double noise_A, double share,
              std::vector<double>* current_A, RandomStream* random) {
  constexpr double kIndependent = 0.1;
  const bool correlated = options.noise == CoverageNoise::kCorrelated;
  if (options.noise != CoverageNoise::kEqual) noise_A *= share;
  const double kept = std::exp(-1.0 / static_cast<double>(current_A->size() - 1));
  double path = 0;
  for (std::size_t k = 0; k < current_A->size(); ++k) {
    if (correlated) {
      path =
          k == 0 ? random->Normal() : kept * path + std::sqrt(1 - kept * kept) * random->Normal();
      (*current_A)[k] += noise_A * path;
    }
    (*current_A)[k] += (correlated ? kIndependent : 1) * noise_A * random->Normal();
  }
}

// The key points of a curve with errors, and the readings that they give.
void StateKeyPoints(KeyPoints points, IvCurve* curve, RandomStream* random) {
  const KeyPointErrors errors;
  points.short_circuit_current_A *= 1 + errors.short_circuit_current * random->Normal();
  points.open_circuit_voltage_V *= 1 + errors.open_circuit_voltage * random->Normal();
  points.max_power_voltage_V *= 1 + errors.max_power_voltage * random->Normal();
  points.max_power_W *= 1 + errors.max_power * random->Normal();
  points.max_power_current_A = points.max_power_W / points.max_power_voltage_V;
  TakeKeyPoints(points, curve);
}

Expected<IvCurve> SimulateCurve(const SimulatedSet& made, const CoverageOptions& options,
                                const std::pair<double, double>& at, RandomStream* random) {
  const auto& [irradiance, temperature_C] = at;
  const Expected<KeyPoints> points = PointsAt(made, irradiance, temperature_C);
  if (!points) return tl::unexpected(points.error());
  const TranslatedDevice module =
      TranslateTo(made.translation, made.truth, irradiance, temperature_C + kZeroCelsius_K);
  IvCurve curve;
  curve.as_is = true;  // no refusal by CheckReadings: the readings are simulated
  curve.conditions.irradiance_W_m2 = irradiance + options.irradiance_error_W_m2;
  curve.conditions.cell_temperature_K =
      temperature_C + kZeroCelsius_K + options.temperature_error_K;
  curve.conditions.cells_in_series = made.translation.spec.cells_in_series;
  if (options.noise == CoverageNoise::kKeyPoints) {
    StateKeyPoints(*points, &curve, random);
    return curve;
  }
  for (int i = 0; i < options.points; ++i) {
    curve.voltage_V.push_back(points->open_circuit_voltage_V * i / (options.points - 1));
  }
  curve.current_A = SolveCurrents(module.device, module.parameters.data(), curve.voltage_V);
  AddNoise(options, made.noise_A, points->short_circuit_current_A / made.reference_isc_A,
           &curve.current_A, random);
  return curve;
}

}  // namespace

Expected<Translation> CoverageTranslation(const CoverageOptions& options, int cells_in_series) {
  const FamilyOptions& family = options.family;
  if (family.recombination) return Fail("coverage is not simulated with the recombination loss");
  TranslationSpec spec;
  spec.law = family.law;
  spec.model = family.model;
  spec.shunt = family.shunt.value_or(family.law == TranslationLaw::kPvsyst ? ShuntLaw::kExponential
                                                                           : ShuntLaw::kInverse);
  spec.cells_in_series = cells_in_series;
  spec.constants = family.constants;
  return MakeTranslation(spec);
}

Expected<SimulatedSet> SimulateSet(const CoverageOptions& options, int index) {
  constexpr int kCells[] = {36, 54, 60, 72};
  RandomStream random(options.seed, static_cast<std::uint64_t>(index));
  const bool stated = !options.module.empty();
  const int cells = stated ? options.cells_in_series : kCells[random.Index(std::size(kCells))];
  auto translation = CoverageTranslation(options, cells);
  if (!translation) return tl::unexpected(translation.error());
  SimulatedSet made;
  made.translation = std::move(*translation);
  Expected<std::vector<double>> truth =
      stated ? StatedModule(made.translation, options)
             : DrawModule(made.translation, options.family.temperature_offset, &random);
  if (!truth) return tl::unexpected(truth.error());
  made.truth = std::move(*truth);
  for (const auto& [name, value] : options.family.fixed) {
    if (const std::optional<int> at = made.translation.Find(name)) made.truth[*at] = value;
  }
  const Expected<KeyPoints> reference = PointsAt(made, kReferenceIrradiance_W_m2, 25);
  if (!reference) return tl::unexpected(reference.error());
  made.reference_isc_A = reference->short_circuit_current_A;
  made.noise_A = options.noise_relative * made.reference_isc_A;
  const int count =
      options.curves > 0
          ? options.curves
          : kFewestCurves + static_cast<int>(random.Index(kMostSetCurves - kFewestCurves + 1));
  made.set.name = fmt::format("set {}", index);
  for (const auto& at : DrawConditions(count, &random)) {
    Expected<IvCurve> curve = SimulateCurve(made, options, at, &random);
    if (!curve) return tl::unexpected(curve.error());
    curve->name = std::to_string(made.set.curves.size());
    made.set.curves.push_back(std::move(*curve));
  }
  return made;
}

}  // namespace lyrefit
