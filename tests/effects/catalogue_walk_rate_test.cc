// Rate test of the catalogue: every effect is simulated and fitted back, and its 95 % interval must
// contain the true strength in 95 % of the cases. All rows in one table, with more curves per row
// than CI runs:
//   LYREFIT_WALK_CURVES=300 tests/fit_rate_test --gtest_filter='CatalogueWalk*'

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "catalogue_walk.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/estimate/fit/simulate.h"

namespace lyrefit {
namespace {

// The voltages of a sweep, in order of measurement.
struct Sweep {
  const char* name;
  std::vector<double> turns;  // turning points, relative to Voc
  int points;                 // number between two turning points
  double seconds;             // duration of the sweep
};

const std::vector<Sweep>& Sweeps() {
  static const std::vector<Sweep> sweeps = {
      {"one sweep", {0, 1.06}, 100, 0.1},
      {"from reverse", {-5, 1.06}, 120, 0.1},
      {"up and down", {0, 1.06, 0}, 60, 0.05},
  };
  return sweeps;
}

struct Place {
  const Effect* effect;
  const Sweep* sweep;

  const char* Data() const { return sweep->name; }
  // Effects with separate cell groups take ten times as long to fit as others.
  int Curves() const { return WalkCurves(effect->groups ? 1 : 4); }
};

// A crystalline silicon cell or module of one or two diodes, at a random temperature.
SimulateOptions DrawDevice(const Effect& effect, RandomStream* random) {
  SimulateOptions made;
  const bool two = effect.diode != 2 && random->Index(2) == 1;
  made.model = two ? Model::kDoubleDiode : Model::kSingleDiode;
  constexpr int kCells[] = {1, 36, 60, 72};
  const int cells = kCells[random->Index(4)];
  made.conditions.cells_in_series = cells;
  made.conditions.cell_temperature_K = Between(random, 285, 335);
  const double vt = ThermalVoltage(made.conditions.cell_temperature_K);
  const double isc = Between(random, 3, 11), voc = Between(random, 0.56, 0.68);
  const double n = two ? Between(random, 1.0, 1.1) : Between(random, 1.05, 1.4);
  const double part = two ? LogUniform(random, 0.05, 0.5) : 0;  // share of the second diode at Voc
  const double is2 = part * isc / std::expm1(voc / (2 * vt));
  made.parameters = {{"Iph", isc},
                     {"Is1", (1 - part) * isc / std::expm1(voc / (n * vt))},
                     {"n1", n},
                     {"Rs", cells * voc / isc * Between(random, 0.01, 0.06)},
                     {"Rsh", cells * voc / isc * LogUniform(random, 20, 200)}};
  if (two) {
    made.parameters["Is2"] = is2;
    made.parameters["n2"] = 2;
  }
  return made;
}

// Simulates the sweep of a device without effects.
Expected<IvCurve> Take(const SimulateOptions& device, const Sweep& sweep) {
  SimulateOptions options = device;
  options.points = 2;
  auto ends = Simulate(options);
  if (!ends) return ends;
  const double voc = ends->voltage_V[1] / 1.02;
  for (std::size_t turn = 0; turn + 1 < sweep.turns.size(); ++turn) {
    for (int k = 0; k < sweep.points; ++k) {
      const double part = (k + 0.5) / sweep.points;
      const double at = sweep.turns[turn] * (1 - part) + sweep.turns[turn + 1] * part;
      options.voltage_V.push_back(voc * at);
    }
  }
  auto curve = Simulate(options);
  if (!curve) return curve;
  const int count = static_cast<int>(curve->size());
  for (int k = 0; k < count; ++k) curve->time_s.push_back(sweep.seconds * k / (count - 1));
  const int cells = device.conditions.cells_in_series;
  if (cells > 1) curve->notes.bypass_diodes = cells == 36 ? 2 : 3;
  return curve;
}

struct Case {
  IvCurve curve;
  FitOptions fit;
  DrawnEffect drawn;
};

// Takes out the readings to which no source meter drives the device: a reverse current of 28 times
// Isc, which drawn breakdowns reach, destroys it.
void KeepWithinASource(const IvCurve& clean, IvCurve* taken) {
  constexpr double kMost = 5;  // of Isc
  const double isc_A = FindKeyPoints(clean.voltage_V, clean.current_A).short_circuit_current_A;
  IvCurve kept = *taken;
  kept.voltage_V.clear();
  kept.current_A.clear();
  kept.time_s.clear();
  for (std::size_t k = 0; k < clean.size(); ++k) {
    if (clean.current_A[k] > kMost * isc_A) continue;
    kept.voltage_V.push_back(taken->voltage_V[k]);
    kept.current_A.push_back(taken->current_A[k]);
    kept.time_s.push_back(taken->time_s[k]);
  }
  *taken = std::move(kept);
}

double DrawNoise(const IvCurve& clean, Model model, RandomStream* random) {
  FitOptions alone;
  alone.model = model;
  alone.intervals = Intervals::kNone;
  alone.random_baseline = false;
  alone.threads = 1;
  const auto base = Fit(clean, alone);
  const double count = static_cast<double>(clean.size());
  const double misfit = base ? base->rmse.refined.solved_current_A * std::sqrt(count) : 0;
  const KeyPoints points = FindKeyPoints(clean.voltage_V, clean.current_A);
  return NoiseFor(misfit, points.short_circuit_current_A, random);
}

// Empty if data of this kind cannot show the effect in this device.
std::optional<Case> DrawCase(const Place& place, RandomStream* random) {
  SimulateOptions device = DrawDevice(*place.effect, random);
  auto taken = Take(device, *place.sweep);
  if (!taken) return std::nullopt;
  const Device base = MakeDevice(device.model, device.conditions);
  const auto extended = Extend(base, device.model, device.constants, *taken, {{place.effect, {}}},
                               /*force=*/false);
  if (!extended) return std::nullopt;
  Case made;
  made.drawn = DrawEffect(*extended, *place.effect, random);
  device.with = {made.drawn.truth};
  device.taken = *taken;
  auto clean = Simulate(device);
  if (!clean) return std::nullopt;
  KeepWithinASource(*clean, &*taken);
  device.taken = *taken;
  clean = Simulate(device);
  if (!clean) return std::nullopt;
  device.noise_A = DrawNoise(*clean, device.model, random);
  device.seed = random->Bits() >> 12;
  made.curve = *Simulate(device);
  // The effect may have changed the curve so much that it is no longer testable.
  if (!Extend(base, device.model, device.constants, made.curve, {made.drawn.asked},
              /*force=*/false)) {
    return std::nullopt;
  }
  made.fit.model = device.model;
  made.fit.with = {made.drawn.asked};
  made.fit.random_baseline = false;
  made.fit.threads = 1;
  return made;
}

WalkRow Walk(const Place& place) {
  WalkRow row;
  const int wanted = place.Curves();
  const std::uint64_t seed = SeedOf(place.effect->id, place.Data());
  for (int draw = 0; row.curves < wanted && draw < 20 * wanted; ++draw) {
    RandomStream random(seed, draw);
    const auto one = DrawCase(place, &random);
    if (!one) continue;
    const auto begin = std::chrono::steady_clock::now();
    const auto report = Fit(one->curve, one->fit);
    CountFit(report, std::chrono::steady_clock::now() - begin, one->drawn, &row);
  }
  return row;
}

std::vector<Place> Places() {
  std::vector<Place> places;
  for (const Effect* effect : Catalogue()) {
    if (!effect->HasStage()) continue;
    for (const Sweep& sweep : Sweeps()) {
      const Place place{effect, &sweep};
      bool shows = false;
      for (std::uint64_t draw = 0; draw < 8 && !shows; ++draw) {
        RandomStream random(1, draw);
        const SimulateOptions device = DrawDevice(*effect, &random);
        const auto taken = Take(device, sweep);
        shows = taken && Extend(MakeDevice(device.model, device.conditions), device.model,
                                device.constants, *taken, {{effect, {}}}, /*force=*/false);
      }
      if (shows) places.push_back(place);
    }
  }
  return places;
}

TEST(CatalogueWalk, FitsBackWhatWasSimulated) { WalkAll(Places(), Walk); }

}  // namespace
}  // namespace lyrefit
