#include "studies/landscape_draw.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lyrefit/effects/catalogue.h"
#include "lyrefit/model/model_points.h"
#include "synthetic/draw.h"

namespace lyrefit {
namespace {

// Voltage of the last crossing of 0 A on a finely sampled curve.
std::optional<double> LastCrossing(const IvCurve& fine) {
  for (std::size_t k = fine.size() - 1; k > 0; --k) {
    const double before = fine.current_A[k - 1], after = fine.current_A[k];
    if (!(before > 0)) continue;
    if (after > 0) return std::nullopt;
    return fine.voltage_V[k - 1] +
           (fine.voltage_V[k] - fine.voltage_V[k - 1]) * before / (before - after);
  }
  return std::nullopt;
}

// Cumulative quantity of the tracer's even steps, from 0 V to each voltage of a finely sampled
// curve.
std::vector<double> Progress(const IvCurve& fine, Tracer tracer, double voc_V) {
  // Relative to the largest current; the capacitor counts as full below it.
  constexpr double kLeastCurrent = 0.02;
  const double isc_A = *std::max_element(fine.current_A.begin(), fine.current_A.end());
  std::vector<double> progress = {0};
  for (std::size_t k = 1; k < fine.size(); ++k) {
    const double dv = (fine.voltage_V[k] - fine.voltage_V[k - 1]) / voc_V;
    const double di = (fine.current_A[k] - fine.current_A[k - 1]) / isc_A;
    double step = dv;
    if (tracer == Tracer::kArc) step = std::hypot(dv, di);
    if (tracer == Tracer::kCharge) step = dv / std::max(fine.current_A[k] / isc_A, kLeastCurrent);
    progress.push_back(progress.back() + step);
  }
  return progress;
}

// Linear interpolation of y at x = `value`; x is increasing.
double Interpolate(const std::vector<double>& x, const std::vector<double>& y, double value) {
  const auto above = std::upper_bound(x.begin() + 1, x.end() - 1, value);
  const std::size_t k = above - x.begin();
  return y[k - 1] + (y[k] - y[k - 1]) * (value - x[k - 1]) / (x[k] - x[k - 1]);
}

// The curve as the tracer samples it.
IvCurve ReadBy(const DrawnDevice& device, const IvCurve& fine, double voc_V) {
  const std::vector<double> progress = Progress(fine, device.tracer, voc_V);
  const double whole = Interpolate(fine.voltage_V, progress, device.beyond * voc_V);
  IvCurve read = fine;
  read.voltage_V.clear();
  read.current_A.clear();
  for (int k = 0; k < device.made.points; ++k) {
    const double at = whole * k / (device.made.points - 1);
    read.voltage_V.push_back(Interpolate(progress, fine.voltage_V, at));
    read.current_A.push_back(Interpolate(progress, fine.current_A, at));
  }
  return read;
}

// The device sampled at many voltages, without noise. Effects require a measurement with the number
// of bypass diodes.
Expected<IvCurve> ReadFinely(const DrawnDevice& device) {
  SimulateOptions made = device.made;
  made.points = 2000;
  made.noise_A = 0;
  made.with.clear();
  Expected<IvCurve> fine = Simulate(made);
  if (!fine) return fine;
  if (device.bypass_diodes > 0) fine->notes.bypass_diodes = device.bypass_diodes;
  made.with = device.made.with;
  made.taken = std::move(*fine);
  return Simulate(made);
}

Values TruthOf(const SimulateOptions& made) {
  Values truth = made.parameters;
  for (const EffectUse& use : made.with) {
    for (const auto& [symbol, range] : use.ranges) {
      truth[use.effect->id + ("." + symbol)] = range.first;
    }
  }
  return truth;
}

}  // namespace

EffectUse Held(const char* effect, const Values& values) {
  EffectUse use{FindEffect(effect), {}};
  for (const auto& [symbol, value] : values) use.ranges[symbol] = {value, value};
  return use;
}

EffectUse Freed(const char* effect, Ranges ranges) {
  return {FindEffect(effect), std::move(ranges)};
}

void DrawMeasurement(double isc_A, double least_noise, double most_noise, RandomStream* random,
                     DrawnDevice* device) {
  // Half of the tracers step the voltage.
  constexpr Tracer kTracers[] = {Tracer::kVoltage, Tracer::kVoltage, Tracer::kArc, Tracer::kCharge};
  device->tracer = kTracers[random->Index(4)];
  device->beyond = Between(random, 1, 1.01);
  device->made.points = WholeBetween(random, 60, 150);
  device->made.noise_A = isc_A * LogUniform(random, least_noise, most_noise);
  device->made.seed = random->Bits();
}

DrawnDevice DrawModule(int substrings, RandomStream* random) {
  DrawnDevice device;
  SimulateOptions& made = device.made;
  const double isc = Between(random, 4, 10);
  const int cells = substrings * WholeBetween(random, 12, 24);
  const double voc = cells * Between(random, 0.58, 0.68);
  const double n = Between(random, 1, 1.4);
  const double resistance = voc / isc;
  made.conditions.cells_in_series = cells;
  const double thermal_V = made.conditions.ModuleThermalVoltage(made.constants);
  made.parameters = {{"Iph", isc},
                     {"Is1", SaturationCurrent(isc, voc, n * thermal_V)},
                     {"n1", n},
                     {"Rs", Between(random, 0.01, 0.04) * resistance},
                     {"Rsh", LogUniform(random, 20, 1000) * resistance}};
  device.bypass_diodes = substrings;
  DrawMeasurement(isc, 2e-4, 2e-3, random, &device);
  return device;
}

Expected<LandscapeCase> Measure(const DrawnDevice& device) {
  const Expected<IvCurve> fine = ReadFinely(device);
  if (!fine) return tl::unexpected(fine.error());
  const std::optional<double> voc_V = LastCrossing(*fine);
  if (!voc_V || *voc_V * device.beyond > fine->voltage_V.back()) {
    return Fail("the device has no open-circuit voltage near that of its cells alone");
  }
  SimulateOptions made = device.made;
  made.taken = ReadBy(device, *fine, *voc_V);
  Expected<IvCurve> curve = Simulate(made);
  if (!curve) return tl::unexpected(curve.error());
  LandscapeCase result;
  result.curve = std::move(*curve);
  result.model = made.model;
  result.bounds = device.bounds;
  result.with = device.with;
  result.truth = TruthOf(made);
  result.noise_A = made.noise_A;
  return result;
}

}  // namespace lyrefit
