#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "faults/random.h"
#include "plant/synthetic_scale_plant.h"

namespace made {
namespace {

using faults::Random;
using faults::SeedOf;

constexpr int kStringsOfCombinerHere = 9;
constexpr int kCombinersHere = 2;

struct ScaleFault {
  const char* name;
  bool (*apply)(Random* random, ScaleString* one);  // false: not of this string
};

constexpr ScaleFault kScaleFaults[] = {
    {"missing_module",
     [](Random* random, ScaleString* one) {
       const int count = random->Chance(0.75) ? 1 : 2;
       if (random->Chance(0.5)) {
         one->built_modules -= count;
       } else {
         one->shorted_modules = count;
       }
       return one->strings == 1;
     }},
    {"bypassed_substring",
     [](Random* random, ScaleString* one) {
       (random->Chance(0.6) ? one->shorted_substrings : one->open_substrings) =
           random->Chance(0.8) ? 1 : 2;
       return one->strings == 1;
     }},
    {"reversed_module",
     [](Random*, ScaleString* one) {
       one->reversed = 1;
       return one->strings == 1;
     }},
    {"disconnected_string",
     [](Random* random, ScaleString* one) {
       one->built_strings -= 1 + (one->strings > 2 ? random->Index(2) : 0);
       return one->strings > 1;
     }},
    {"wrong_module_type",
     [](Random* random, ScaleString* one) {
       one->built_type = kPlannedTypes + random->Index(3);
       return true;
     }},
    {"cable_resistance",
     [](Random* random, ScaleString* one) {
       one->lead_ohm += random->Uniform(1.5, 4) * one->modules / 12;
       return true;
     }},
    {"uniform_soiling",
     [](Random* random, ScaleString* one) {
       one->clean *= 1 - random->Uniform(0.06, 0.20);
       return true;
     }},
    {"light_sensor",
     [](Random* random, ScaleString* one) {
       const double off = random->Uniform(0.07, 0.20);
       one->light_reading *= random->Chance(0.5) ? 1 + off : 1 - off;
       return true;
     }},
    {"temperature_sensor",
     [](Random* random, ScaleString* one) {
       const double off = random->Uniform(8, 25);
       one->kelvin_reading += random->Chance(0.7) ? -off : off;
       return true;
     }},
};

// Exchanges two strings of unlike plan in a combiner, if there are such.
bool Exchange(Random* random, std::vector<ScaleString>* strings, int combiner) {
  std::vector<int> few, many;
  for (int i = combiner * kStringsOfCombinerHere; i < (combiner + 1) * kStringsOfCombinerHere;
       ++i) {
    const ScaleString& one = (*strings)[static_cast<std::size_t>(i)];
    if (!one.fault.empty()) continue;
    (one.modules == (*strings)[0].modules ? many : few).push_back(i);
  }
  if (few.empty() || many.empty()) return false;
  ScaleString& a = (*strings)[static_cast<std::size_t>(
      few[static_cast<std::size_t>(random->Index(static_cast<int>(few.size())))])];
  ScaleString& b = (*strings)[static_cast<std::size_t>(
      many[static_cast<std::size_t>(random->Index(static_cast<int>(many.size())))])];
  std::swap(a.built_modules, b.built_modules);
  a.fault = b.fault = "exchanged_strings";
  return true;
}

// What all strings of a combiner share.
void ShareError(Random* random, std::vector<ScaleString>* strings) {
  const int kind = random->Index(3), combiner = random->Index(kCombinersHere);
  const double part = random->Uniform(0.14, 0.25), kelvin = random->Uniform(14, 25);
  const bool up = random->Chance(0.5);
  for (int i = combiner * kStringsOfCombinerHere; i < (combiner + 1) * kStringsOfCombinerHere;
       ++i) {
    ScaleString& one = (*strings)[static_cast<std::size_t>(i)];
    if (kind == 0) one.light_reading *= up ? 1 + part : 1 - part;
    if (kind == 1) one.clean *= 1 - part + 0.01 * random->Normal();
    if (kind == 2) one.kelvin_reading += up ? kelvin : -kelvin;
    constexpr const char* kNames[] = {"shared light_sensor", "shared uniform_soiling",
                                      "shared temperature_sensor"};
    if (one.fault.empty()) one.fault = kNames[kind];
  }
}

}  // namespace

ScalePlant DrawScalePlant(std::uint64_t seed, int number) {
  Random random(SeedOf(seed, number));
  ScalePlant plant;
  plant.current_class = 1 + 0.008 * random.Normal();
  plant.voltage_class = 1 + 0.003 * random.Normal();
  const int type = random.Index(kPlannedTypes), modules = 10 + random.Index(5);
  const bool mixed = random.Chance(0.3);  // strings of two lengths in each combiner
  // All inputs measure strings in parallel.
  const int parallel = number % 5 == 4 ? 2 + random.Index(2) : 1;
  const double suns = random.Uniform(0.55, 1.0), air = random.Uniform(5, 32);
  for (int i = 0; i < kCombinersHere * kStringsOfCombinerHere; ++i) {
    ScaleString one;
    const int combiner = i / kStringsOfCombinerHere;
    char id[60];
    std::snprintf(id, sizeof id, "p%03d/comb%d/str%02d", number, combiner + 1,
                  i % kStringsOfCombinerHere + 1);
    one.id = id;
    one.type = one.built_type = type;
    one.modules = mixed && i % 3 == 2 ? modules - 2 : modules;
    one.strings = parallel;
    if (parallel > 1) one.modules = 8;
    one.built_modules = one.modules;
    one.built_strings = one.strings;
    one.suns = suns * (1 + 0.004 * (i % kStringsOfCombinerHere)) * (1 + 0.004 * random.Normal());
    one.kelvin = kZeroCelsius + air + 28 * suns + 0.7 * random.Normal();
    one.clean = 1 - 0.008 * std::fabs(random.Normal());
    one.lead_ohm = random.Uniform(0.05, 0.35);
    Random sensor(SeedOf(seed + 77, number * kCombinersHere + combiner));
    one.light_reading = (1 + 0.012 * sensor.Normal()) * (1 + 0.006 * random.Normal());
    one.kelvin_reading = 0.8 * sensor.Normal() + 0.8 * random.Normal();
    plant.strings.push_back(one);
  }
  if (mixed && parallel == 1) Exchange(&random, &plant.strings, random.Index(kCombinersHere));
  const int faults = 3 + random.Index(2);
  for (int hidden = 0; hidden < faults;) {
    const int at = random.Index(static_cast<int>(plant.strings.size()));
    // In each plant the kinds take turns, so that all are as frequent.
    const ScaleFault& fault =
        kScaleFaults[static_cast<std::size_t>((number * 4 + hidden) % std::size(kScaleFaults))];
    ScaleString& one = plant.strings[static_cast<std::size_t>(at)];
    if (!one.fault.empty()) continue;
    ScaleString changed = one;
    if (!fault.apply(&random, &changed)) {
      ++hidden;
      continue;
    }
    changed.fault = fault.name;
    one = changed;
    ++hidden;
  }
  const int spoilt = random.Index(static_cast<int>(plant.strings.size()));
  ScaleString& shaped = plant.strings[static_cast<std::size_t>(spoilt)];
  if (number % 2 == 1 && shaped.fault.empty()) {
    shaped.fault = "shape";
    shaped.degraded = random.Chance(0.4);
    if (!shaped.degraded) shaped.shaded = 1 + random.Index(4);
  }
  if (number % 3 == 0) ShareError(&random, &plant.strings);
  return plant;
}

}  // namespace made
