#include "plant/synthetic_strings.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "faults/field_case.h"
#include "faults/random.h"

namespace made {
namespace {

using faults::Random;
using faults::SeedOf;
using faults::field::Cell;
using faults::field::Group;
using faults::field::Module;
using faults::field::ModuleType;
using faults::field::Sampled;

constexpr ModuleType kType = {/*seed=*/3, kCellsOfModule, kGroupsOfModule, /*current=*/9.6,
                              /*open_circuit_V=*/0.655};
// What a broken module is replaced with: less current, more voltage.
constexpr ModuleType kOtherType = {/*seed=*/8, kCellsOfModule, kGroupsOfModule, /*current=*/9.2,
                                   /*open_circuit_V=*/0.675};
constexpr double kCelsius = 273.15;

struct Weather {
  double suns, kelvin;
  std::string date;
};

constexpr double kStandardKelvin = kCelsius + 25;

// One inverter per day, one string every 70 seconds around noon of a clear day.
Weather WeatherOf(int place, int years) {
  constexpr int kOfDay = kCombiners * kStringsOfCombiner;
  const bool later = years % 2 == 1;
  const int day = place / kOfDay;
  const int minute = (place % kOfDay) * 70 / 60;
  const double hour = 10.5 + minute / 60.0;
  Weather weather;
  weather.suns =
      (day % 2 == 0 ? (later ? 0.92 : 0.96) : (later ? 0.97 : 0.91)) * std::cos((hour - 13) * 0.26);
  weather.kelvin = kCelsius + (later ? 23 : 19) + 1.1 * (hour - 10.5) + 27 * weather.suns;
  weather.date = Text("%d-06-%02d %02d:%02d", 2026 + years, (later ? 21 : 16) + day,
                      (630 + minute) / 60, (630 + minute) % 60);
  return weather;
}

Module WholeString(const StringRig& rig) {
  Module whole;
  for (const Module& module : rig.modules) {
    whole.groups.insert(whole.groups.end(), module.groups.begin(), module.groups.end());
  }
  const double ohm = rig.lead_ohm / whole.CellsInSeries();
  for (Group& group : whole.groups) {
    for (Cell& cell : group.chains[0]) cell.series_ohm += ohm;
  }
  return whole;
}

KeyPoints KeyPointsOf(const Sampled& curve) {
  KeyPoints key{ShortCircuit(curve), OpenCircuit(curve), 0, 0};
  for (int i = 0; i <= 4000; ++i) {
    const double voltage = key.voc * (0.4 + 0.6 * i / 4000), current = curve.CurrentAt(voltage);
    if (voltage * current > key.pmax()) key.imp = current, key.vmp = voltage;
  }
  return key;
}

// What one sweep differs in from another of the same string: dust, warmth, sky and tracer.
struct Passing {
  double clean, kelvin, last_current, first_voltage;
  int points;
  std::vector<double> wander;
};

// A string without a fault, measured by a tracer that charges a capacitor. All that is permanent
// comes from `random`; `passing` has what a later sweep changes.
StringRig HealthyString(const Weather& weather, const Passing* passing, Random* random) {
  StringRig rig;
  double clean = 1 - 0.004 * std::fabs(random->Normal());  // slight soiling
  double kelvin = weather.kelvin + 0.7 * random->Normal();
  if (passing != nullptr) {
    clean = passing->clean;
    kelvin = passing->kelvin;
  }
  rig.suns = weather.suns * clean;
  rig.kelvin = kelvin;
  for (int m = 0; m < kModules; ++m) {
    const double power_class = 1 + 0.003 * std::clamp(random->Normal(), -2.5, 2.5);
    rig.modules.push_back(faults::field::DrawOfType(kType, weather.suns * clean * power_class,
                                                    kelvin + 0.6 * random->Normal(), random));
  }
  rig.lead_ohm = random->Uniform(0.05, 0.35);
  rig.sky.wander = faults::field::DrawWander(random->LogUniform(2e-4, 8e-4), random);
  rig.tracer.drive = faults::field::Drive::kCapacitor;
  rig.tracer.points = 40 + random->Index(41);
  rig.tracer.last_current = random->Uniform(0.005, 0.03);
  rig.tracer.first_voltage = random->Uniform(0.002, 0.02);
  rig.tracer.current_noise = rig.tracer.voltage_noise = 2e-4;
  rig.tracer.current_step = rig.tracer.voltage_step = 1.6 / 16384;
  if (passing != nullptr) {
    rig.sky.wander = passing->wander;
    rig.tracer.points = passing->points;
    rig.tracer.last_current = passing->last_current;
    rig.tracer.first_voltage = passing->first_voltage;
  }
  return rig;
}

Passing DrawPassing(const Weather& weather, Random* fresh) {
  Passing passing;
  passing.clean = 1 - 0.004 * std::fabs(fresh->Normal());
  passing.kelvin = weather.kelvin + 0.7 * fresh->Normal();
  passing.wander = faults::field::DrawWander(fresh->LogUniform(2e-4, 8e-4), fresh);
  passing.points = 40 + fresh->Index(41);
  passing.last_current = fresh->Uniform(0.005, 0.03);
  passing.first_voltage = fresh->Uniform(0.002, 0.02);
  return passing;
}

// About half a percent of power a year: less light reaches the cells, and their contacts corrode.
void Age(int years, Random* ageing, StringRig* rig) {
  const double whole = 0.0038 + 0.0012 * ageing->Normal();
  for (Module& module : rig->modules) {
    const double light = 1 - years * (whole + 0.0015 * ageing->Normal());
    const double ohm = 1 + years * 0.02 * std::fabs(ageing->Normal());
    for (Group& group : module.groups) {
      for (Cell& cell : group.chains[0]) {
        cell.photocurrent *= light;
        cell.series_ohm *= ohm;
      }
    }
  }
}

// A string as it is under some weather, with the random numbers that go on with it.
struct BuiltString {
  StringRig rig;
  StringRig without;  // its fault and its change, or its change alone where there is one
  faults::field::Departure departure;
};

BuiltString Build(const Slot& slot, const PlantRequest& request, const Weather& weather,
                  const Passing* passing, Random* random) {
  BuiltString built;
  built.rig = HealthyString(weather, passing, random);
  built.departure = faults::field::DrawDeparture(random);
  const double missed = random->LogUniform(3e-4, 1e-3);
  SettleDeparture(CurveOf(WholeString(built.rig)), missed, &built.departure);
  if (request.years > 0) {
    Random ageing(SeedOf(request.seed, 3'000'000 + slot.who));
    Age(request.years, &ageing, &built.rig);
  }
  built.without = built.rig;
  const bool lasts = slot.fault != nullptr && (request.years == 0 || !slot.fault->of_sweep);
  const bool repaired = slot.change != nullptr && slot.change->of == ChangeOf::kRepair;
  if (lasts && !repaired) slot.fault->apply(random, &built.rig);
  if (slot.change != nullptr && slot.change->apply != nullptr) {
    built.without = built.rig;
    Random change(SeedOf(request.seed, 4'000'000 + slot.who));
    slot.change->apply(&change, &built.rig);
  }
  return built;
}

}  // namespace

std::string Text(const char* format, ...) {
  char buffer[400];
  va_list values;
  va_start(values, format);
  std::vsnprintf(buffer, sizeof buffer, format, values);
  va_end(values);
  return buffer;
}

Module DrawPlantModule(bool other_type, double suns, double kelvin, Random* random) {
  return faults::field::DrawOfType(other_type ? kOtherType : kType, suns, kelvin, random);
}

KeyPoints ModuleAt(double suns, double celsius) {
  Random typical(7);
  return KeyPointsOf(CurveOf(faults::field::DrawOfType(kType, suns, celsius + kCelsius, &typical)));
}

std::string IdOf(int place) {
  const int combiner = place / kStringsOfCombiner;
  return Text("elm/inv%02d/comb%02d/str%02d", combiner / kCombiners + 1, combiner % kCombiners + 1,
              place % kStringsOfCombiner + 1);
}

Strung Measure(const Slot& slot, const PlantRequest& request) {
  Random random(SeedOf(request.seed, slot.who));
  Random later(SeedOf(request.seed, slot.where, request.years));
  const Weather weather = WeatherOf(slot.where, request.years);
  Strung strung;
  strung.id = slot.id;
  strung.date = weather.date;
  const bool again = request.years > 0;
  Passing passing;
  if (again) passing = DrawPassing(weather, &later);
  const BuiltString built = Build(slot, request, weather, again ? &passing : nullptr, &random);
  Random* const noise = again ? &later : &random;
  faults::field::Rig whole;
  whole.departure = built.departure;
  whole.module = WholeString(built.rig);
  whole.sky = built.rig.sky;
  whole.tracer = built.rig.tracer;
  faults::field::Lit lit(whole.module);
  strung.loss_percent = 100 * (1 - KeyPointsOf(lit.Whole()).pmax() /
                                       KeyPointsOf(CurveOf(WholeString(built.without))).pmax());
  strung.readings = Measured(whole, &lit, noise);
  // The sensor is set up anew at each combiner, and calibrated anew for each campaign.
  Random sensor(SeedOf(request.seed, 1'000'000 + slot.where / kStringsOfCombiner, request.years));
  const double calibrated = request.years % 2 == 0 ? 1 : 1.012;
  const double gain = calibrated * (1 + 0.004 * sensor.Normal() + 0.006 * noise->Normal());
  const double warmer = request.years % 2 == 0 ? 0 : 0.5;
  strung.irradiance_Wm2 = std::round(1000 * weather.suns * gain);
  strung.temperature_C =
      std::round(10 * (weather.kelvin + warmer - kCelsius + noise->Normal())) / 10;
  return strung;
}

double StandardPower(const Slot& slot, const PlantRequest& request) {
  Random random(SeedOf(request.seed, slot.who));
  const Weather standard = {1, kStandardKelvin, ""};
  Passing passing;
  passing.clean = 1;
  passing.kelvin = kStandardKelvin;
  return KeyPointsOf(CurveOf(WholeString(Build(slot, request, standard, &passing, &random).rig)))
      .pmax();
}

}  // namespace made
