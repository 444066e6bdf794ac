// The catalogue walk: whatever effect is simulated is fitted back, and its strength lies in its 95
// % interval as often as that says. All rows in one table, with more curves each than CI has time
// for:
//   LYREFIT_WALK_CURVES=300 tests/fit_rate_test --gtest_filter='*CatalogueWalk*'

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "lyrefit/base/random.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/fit/fit.h"
#include "lyrefit/fit/simulate.h"
#include "lyrefit/law/extension.h"
#include "lyrefit/study/coverage.h"

namespace lyrefit {
namespace {

constexpr double kVanishing = 1e-4;  // probability that honest intervals fail a row

int Curves() {
  const char* const asked = std::getenv("LYREFIT_WALK_CURVES");
  return asked != nullptr ? std::max(1, std::atoi(asked)) : 20;
}

// How a curve is taken: the voltages in parts of Voc, in order.
struct Sweep {
  const char* name;
  std::vector<double> turns;  // in parts of Voc
  int points;                 // of each stretch between two turns
  double seconds;             // of the whole
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
};

void PrintTo(const Place& place, std::ostream* out) {
  *out << place.effect->id << ", " << place.sweep->name;
}

double Between(RandomStream* random, double low, double high) {
  return low + (high - low) * random->Uniform();
}

double LogUniform(RandomStream* random, double low, double high) {
  return low * std::pow(high / low, random->Uniform());
}

// A crystalline cell or module of one or two diodes at some temperature.
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
  const double part = two ? LogUniform(random, 0.05, 0.5) : 0;  // of the second diode, at Voc
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

// Readings of the device as the sweep takes them, as yet without effects.
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

// Values of an effect's parameters, in its own numbers: somewhere between two of the places it is
// tried from, at up to twice or half that strength, of either sign where it may have both.
std::vector<double> DrawEffect(const Effect& effect, const DataTraits& traits,
                               RandomStream* random) {
  const std::vector<Probe> probes = effect.probes(traits);
  Probe p = probes[random->Index(static_cast<std::uint32_t>(probes.size()))];
  const Probe& other = probes[random->Index(static_cast<std::uint32_t>(probes.size()))];
  for (int k = 0; k < effect.size(); ++k) {
    const EffectParameter& info = effect.parameters[k];
    if (!info.searched && !info.held) p[k] = Between(random, p[k], other[k]);
  }
  const EffectParameter& strength = effect.parameters[0];
  if (strength.neutral == 0) p[0] *= LogUniform(random, 0.5, 2);
  if (strength.lower == -strength.upper && random->Index(2) == 1) p[0] = -p[0];
  p[0] = std::min(p[0], 0.9 * strength.upper);
  return p;
}

// One curve with its truth.
struct Case {
  IvCurve curve;
  FitOptions fit;
  EffectUse truth;
  double strength = 0;
};

// Noise that the effect stands out of by 10 to 50 standard deviations (after all that the diodes
// can do to look like it), as far as instruments have such a noise.
double DrawNoise(const IvCurve& clean, Model model, RandomStream* random) {
  FitOptions alone;
  alone.model = model;
  alone.intervals = Intervals::kNone;
  alone.random_baseline = false;
  alone.threads = 1;
  const auto base = Fit(clean, alone);
  const double count = static_cast<double>(clean.size());
  const double misfit = base ? base->rmse.refined.solved_current_A * std::sqrt(count) : 0;
  const double scale = *std::max_element(clean.current_A.begin(), clean.current_A.end());
  return std::min(std::max(misfit / LogUniform(random, 10, 50), 2e-5 * scale), 5e-3 * scale);
}

// Nothing where data of this kind cannot show the effect in this device.
std::optional<Case> DrawCase(const Place& place, RandomStream* random) {
  const Effect& effect = *place.effect;
  SimulateOptions device = DrawDevice(effect, random);
  auto taken = Take(device, *place.sweep);
  if (!taken) return std::nullopt;
  const Device base = MakeDevice(device.model, device.conditions, device.constants);
  const auto extended =
      Extend(base, device.model, device.constants, *taken, {{&effect, {}}}, /*force=*/false);
  if (!extended) return std::nullopt;
  const std::vector<double> inner =
      DrawEffect(effect, extended->extension->readings.traits, random);
  std::vector<double> p(base.size(), 0);
  p.insert(p.end(), inner.begin(), inner.end());
  const std::vector<double> values = Reported(*extended, p);
  Case made;
  EffectUse truth{&effect, {}}, asked{&effect, {}};
  for (int k = 0; k < effect.size(); ++k) {
    const EffectParameter& info = effect.parameters[k];
    const double value = values[base.size() + k];
    truth.ranges[info.symbol] = {value, value};
    if (!info.held) continue;
    asked.ranges[info.symbol] =
        k == 0 ? std::pair(info.lower, info.upper) : std::pair(value, value);
  }
  device.with = {truth};
  device.taken = *taken;
  const auto clean = Simulate(device);
  if (!clean) return std::nullopt;
  device.noise_A = DrawNoise(*clean, device.model, random);
  device.seed = random->Bits() >> 12;
  made.curve = *Simulate(device);
  if (!Extend(base, device.model, device.constants, made.curve, {asked}, /*force=*/false)) {
    return std::nullopt;
  }
  made.fit.model = device.model;
  made.fit.with = {asked};
  made.fit.random_baseline = false;
  made.fit.threads = 1;
  made.truth = truth;
  made.strength = values[base.size()];
  return made;
}

struct Row {
  int curves = 0;
  int held = 0;
  int counted = 0;           // with an interval
  int not_identifiable = 0;  // as the report says
  int failed = 0;
  double milliseconds = 0;
};

const Estimate& StrengthOf(const FitReport& report, const Effect& effect) {
  const std::string symbol = std::string(effect.id) + "." + effect.parameters[0].symbol;
  return *std::find_if(report.estimates.begin(), report.estimates.end(),
                       [&](const Estimate& e) { return e.info.symbol == symbol; });
}

void Say(const Case& one, const FitReport& report, const Estimate& e) {
  if (std::getenv("LYREFIT_WALK_VERBOSE") == nullptr) return;
  std::printf(
      "   %s Ns=%d truth %-11.5g is %-11.5g [%.5g, %.5g] %s%s rmse/noise %.3f start '%s' %s %s\n",
      ToText(report.model).c_str(), one.curve.conditions.cells_in_series, one.strength, e.refined,
      e.low_95, e.high_95, ToText(e.interval).c_str(),
      e.low_95 <= one.strength && one.strength <= e.high_95 ? "" : " MISSED",
      report.rmse.refined.solved_current_A / *one.curve.notes.current_noise_constant_A,
      report.refine.winner < 0 ? "" : report.refine.starts[report.refine.winner].origin.c_str(),
      e.identifiable ? "" : "n.i.: ", e.reason.c_str());
}

void Count(const Case& one, const Effect& effect, Row* row) {
  const auto begin = std::chrono::steady_clock::now();
  const auto report = Fit(one.curve, one.fit);
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
  row->milliseconds += took.count();
  ++row->curves;
  if (!report || !report->usable) {
    ++row->failed;
    ADD_FAILURE() << DescribeUse(one.truth) << " in " << ToText(one.fit.model) << " of "
                  << one.curve.conditions.cells_in_series << " cells: "
                  << (report ? report->not_usable_because : report.error().ToString());
    if (report) Say(one, *report, StrengthOf(*report, effect));
    return;
  }
  const Estimate& e = StrengthOf(*report, effect);
  Say(one, *report, e);
  if (!e.identifiable) {
    ++row->not_identifiable;
    return;
  }
  ++row->counted;
  row->held += e.low_95 <= one.strength && one.strength <= e.high_95;
}

Row Walk(const Place& place) {
  Row row;
  int wanted = Curves(), tries = 0;
  for (std::uint64_t draw = 0; row.curves < wanted && tries < 20 * wanted; ++draw, ++tries) {
    RandomStream random(20260111, draw);
    if (const auto one = DrawCase(place, &random)) Count(*one, *place.effect, &row);
  }
  return row;
}

// Probability of at most `hits` of `trials` that come with probability p each.
double AtMost(int hits, int trials, double p) {
  double sum = 0;
  for (int k = 0; k <= hits; ++k) {
    sum +=
        std::exp(std::lgamma(trials + 1.0) - std::lgamma(k + 1.0) - std::lgamma(trials - k + 1.0) +
                 k * std::log(p) + (trials - k) * std::log1p(-p));
  }
  return sum;
}

void Print(const Place& place, const Row& row) {
  static bool first = true;
  if (first) {
    std::printf("%-16s %-12s %6s %7s  %-15s %6s %6s %8s\n", "effect", "data", "curves", "held %",
                "Wilson 95 %", "not id", "failed", "ms a fit");
  }
  first = false;
  const Share share = WilsonInterval(row.held, row.counted);
  std::printf("%-16s %-12s %6d %7.1f  %5.1f to %5.1f %6d %6d %8.1f\n", place.effect->id,
              place.sweep->name, row.curves, 100.0 * row.held / std::max(row.counted, 1),
              100 * share.low_95, 100 * share.high_95, row.not_identifiable, row.failed,
              row.milliseconds / std::max(row.curves, 1));
  std::fflush(stdout);
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

class CatalogueWalk : public ::testing::TestWithParam<Place> {};

TEST_P(CatalogueWalk, FitsBackWhatWasSimulated) {
  const Row row = Walk(GetParam());
  Print(GetParam(), row);
  EXPECT_EQ(row.curves, Curves());
  EXPECT_EQ(row.failed, 0);
  const int missed = row.counted - row.held;
  EXPECT_GT(AtMost(row.held, row.counted, 0.95), kVanishing) << "too narrow";
  EXPECT_GT(AtMost(missed, row.counted, 0.05), kVanishing) << "too wide";
}

std::string NameOf(const ::testing::TestParamInfo<Place>& info) {
  std::string name = std::string(info.param.effect->id) + "_" + info.param.sweep->name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, CatalogueWalk, ::testing::ValuesIn(Places()), NameOf);

}  // namespace
}  // namespace lyrefit
