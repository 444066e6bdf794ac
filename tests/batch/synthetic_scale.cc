#include "batch/synthetic_scale.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>
#include <vector>

#include "faults/field_draw.h"
#include "faults/field_tracer.h"
#include "faults/random.h"

namespace made {
namespace {

using faults::Random;
using faults::SeedOf;
using faults::field::Bypass;
using faults::field::Cell;
using faults::field::Group;
using faults::field::Module;
using faults::field::ModuleType;
using faults::field::Sampled;

constexpr double kZeroCelsius = 273.15;
constexpr int kStringsOfCombinerHere = 9;
constexpr int kCombinersHere = 2;

// Types of modules: the plan's are 0 to 2, wrong ones any other.
constexpr ModuleType kTypes[] = {
    {3, 60, 3, 9.6, 0.655}, {11, 72, 3, 9.1, 0.640}, {19, 60, 3, 10.4, 0.690},
    {27, 72, 3, 8.3, 0.625}, {35, 54, 3, 8.8, 0.670}, {43, 60, 3, 8.6, 0.635}};
constexpr int kPlannedTypes = 3;

__attribute__((format(printf, 1, 2))) std::string Said(const char* format, ...) {
  char buffer[500];
  va_list values;
  va_start(values, format);
  std::vsnprintf(buffer, sizeof buffer, format, values);
  va_end(values);
  return buffer;
}

// How a string is planned, built and measured.
struct ScaleString {
  std::string id;
  int type = 0, modules = 0, strings = 1;  // planned
  int built_type = 0, built_modules = 0, built_strings = 1;
  int reversed = 0;
  int shorted_modules = 0, shorted_substrings = 0, open_substrings = 0;
  int shaded = 0;            // substrings in the shade of a pole
  bool degraded = false;     // shunts by potential
  double clean = 1;          // light that the glass passes
  double lead_ohm = 0;       // of each string
  double light_reading = 1;  // shown by the sensor over true
  double kelvin_reading = 0;
  std::string fault;         // empty: none
  double suns = 1, kelvin = 298;
  faults::field::Readings readings;
  double power = 0;  // largest, W
};

struct ScalePlant {
  std::vector<ScaleString> strings;
  double current_class = 1, voltage_class = 1;  // of its modules against their data sheet
};

struct Peak {
  double isc, voc, imp, vmp;
};

Peak PeakOf(const Sampled& curve) {
  Peak peak{ShortCircuit(curve), OpenCircuit(curve), 0, 0};
  for (int i = 0; i <= 4000; ++i) {
    const double voltage = peak.voc * (0.4 + 0.6 * i / 4000), current = curve.CurrentAt(voltage);
    if (voltage * current > peak.imp * peak.vmp) peak.imp = current, peak.vmp = voltage;
  }
  return peak;
}

Peak TypicalAt(const ModuleType& type, double suns, double celsius) {
  Random typical(7);
  return PeakOf(CurveOf(faults::field::DrawOfType(type, suns, celsius + kZeroCelsius, &typical)));
}

std::string SheetOf(int t) {
  const ModuleType& type = kTypes[t];
  const Peak cool = TypicalAt(type, 1, 25), warm = TypicalAt(type, 1, 50);
  const auto percent = [](double one, double other) { return 100 * (other / one - 1) / 25; };
  return Said(
      "{\"name\": \"Type %d\", \"cells_in_series\": %d, \"bypass_diodes\": %d,\n"
      " \"short_circuit_current_A\": %.2f, \"open_circuit_voltage_V\": %.1f,\n"
      " \"max_power_current_A\": %.2f, \"max_power_voltage_V\": %.1f,\n"
      " \"alpha_sc_percent_K\": %.3f, \"beta_oc_percent_K\": %.3f}\n",
      t, type.cells, type.groups, cool.isc, cool.voc, cool.imp, cool.vmp,
      percent(cool.isc, warm.isc), percent(cool.voc, warm.voc));
}

// Faults of the shape, which are not to be taken for one of the scale.
void SpoilShape(const ScaleString& one, Random* random, std::vector<Module>* modules) {
  for (int s = 0; s < one.shaded; ++s) {
    Group& group = (*modules)[static_cast<std::size_t>(s / 2)].groups[static_cast<std::size_t>(s % 2)];
    const double light = random->Uniform(0.3, 0.75);
    for (Cell& cell : group.chains[0]) cell.photocurrent *= light;
  }
  for (std::size_t m = 0; one.degraded && m < modules->size() / 2; ++m) {
    const double strength = 0.15 * (1 - 2.0 * static_cast<double>(m) / static_cast<double>(modules->size()));
    for (Group& group : (*modules)[m].groups) {
      for (Cell& cell : group.chains[0]) {
        cell.shunt_S += cell.photocurrent / 0.6 * strength * random->LogUniform(0.5, 2);
      }
    }
  }
}

// The curve of one row of modules.
Sampled CurveOfRow(const ScaleString& one, const ScalePlant& plant, Random* random) {
  ModuleType type = kTypes[one.built_type];
  type.open_circuit_V *= plant.voltage_class;
  std::vector<Module> modules;
  for (int m = 0; m < one.built_modules; ++m) {
    const double power_class = 1 + 0.003 * std::clamp(random->Normal(), -2.5, 2.5);
    modules.push_back(faults::field::DrawOfType(
        type, one.suns * one.clean * power_class * plant.current_class,
        one.kelvin + 0.6 * random->Normal(), random));
  }
  for (int m = 0; m < one.shorted_modules + one.shorted_substrings; ++m) {
    std::vector<Group>& groups = modules[static_cast<std::size_t>(2 * m + 1)].groups;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (m >= one.shorted_modules && g > 0) continue;
      groups[g].bypass = Bypass::kShorted;
      groups[g].short_ohm = random->LogUniform(2e-3, 2e-2);
    }
  }
  for (int m = 0; m < one.open_substrings; ++m) {
    modules[static_cast<std::size_t>(2 * m)].groups[1].broken = true;
  }
  SpoilShape(one, random, &modules);
  Module whole;
  for (int m = one.reversed; m < one.built_modules; ++m) {
    const auto& groups = modules[static_cast<std::size_t>(m)].groups;
    whole.groups.insert(whole.groups.end(), groups.begin(), groups.end());
  }
  const double ohm = one.lead_ohm / whole.CellsInSeries();
  for (Group& group : whole.groups) {
    for (Cell& cell : group.chains[0]) cell.series_ohm += ohm;
  }
  Sampled curve = CurveOf(whole);
  // A module in reverse carries -I: CurveOf covers currents down to -1.3 Iph.
  for (int r = 0; r < one.reversed; ++r) {
    const Sampled against = CurveOf(modules[static_cast<std::size_t>(r)]);
    const double largest = whole.LargestPhotocurrent();
    std::vector<faults::field::Point> points;
    for (faults::field::Point point : curve.points) {
      if (point.current < -0.3 * largest) continue;
      const faults::field::Point other = against.PointAtCurrent(-point.current);
      point.voltage -= other.voltage;
      point.slope += other.slope;
      points.push_back(point);
    }
    curve.points = points;
  }
  return curve;
}

Sampled CurveOfString(const ScaleString& one, const ScalePlant& plant, Random* random) {
  std::vector<Sampled> rows;
  for (int s = 0; s < one.built_strings; ++s) {
    rows.push_back(CurveOfRow(one, plant, random));
  }
  std::vector<const Sampled*> all;
  for (const Sampled& row : rows) all.push_back(&row);
  return all.size() == 1 ? rows.front() : SideBySide(all);
}

// A tracer that charges a capacitor; noise of 0.02 %, steps of a 14-bit converter.
faults::field::Readings ReadingsOf(const Sampled& curve, Random* random) {
  faults::field::Tracer tracer;
  tracer.drive = faults::field::Drive::kCapacitor;
  tracer.points = 40 + random->Index(41);
  tracer.last_current = random->Uniform(0.005, 0.03);
  tracer.first_voltage = random->Uniform(0.002, 0.02);
  const double isc = ShortCircuit(curve), voc = OpenCircuit(curve);
  faults::field::Readings readings;
  for (const faults::field::Instant& now : Instants(tracer, curve)) {
    const double current = curve.CurrentAt(now.voltage) + 2e-4 * isc * random->Normal();
    const double voltage = now.voltage + 2e-4 * voc * random->Normal();
    const double step = 1.6 / 16384;
    readings.current.push_back(step * isc * std::round(current / (step * isc)));
    readings.voltage.push_back(step * voc * std::round(voltage / (step * voc)));
  }
  return readings;
}

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
  ScaleString& a = (*strings)[static_cast<std::size_t>(few[static_cast<std::size_t>(
      random->Index(static_cast<int>(few.size())))])];
  ScaleString& b = (*strings)[static_cast<std::size_t>(many[static_cast<std::size_t>(
      random->Index(static_cast<int>(many.size())))])];
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

ScalePlant DrawPlant(std::uint64_t seed, int number) {
  Random random(SeedOf(seed, number));
  ScalePlant plant;
  plant.current_class = 1 + 0.008 * random.Normal();
  plant.voltage_class = 1 + 0.003 * random.Normal();
  const int type = random.Index(kPlannedTypes), modules = 10 + random.Index(5);
  const bool mixed = random.Chance(0.3);     // strings of two lengths in each combiner
  // All inputs measure strings in parallel.
  const int parallel = number % 5 == 4 ? 2 + random.Index(2) : 1;
  const double suns = random.Uniform(0.55, 1.0), air = random.Uniform(5, 32);
  for (int i = 0; i < kCombinersHere * kStringsOfCombinerHere; ++i) {
    ScaleString one;
    const int combiner = i / kStringsOfCombinerHere;
    one.id = Said("p%03d/comb%d/str%02d", number, combiner + 1, i % kStringsOfCombinerHere + 1);
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

std::string PackedPlant(const ScalePlant& plant) {
  std::string text = "id,irradiance_Wm2,temperature_C,cells_in_series,voltage_V,current_A\n";
  for (const ScaleString& one : plant.strings) {
    text += Said("%s,%.0f,%.1f,%d,", one.id.c_str(), 1000 * one.suns * one.light_reading,
                 one.kelvin - kZeroCelsius + one.kelvin_reading,
                 one.modules * kTypes[one.type].cells);
    for (const double v : one.readings.voltage) text += Said("%.2f ", v);
    text.back() = ',';
    for (const double i : one.readings.current) text += Said("%.3f ", i);
    text.back() = '\n';
  }
  return text;
}

std::string PlanText(const ScalePlant& plant) {
  std::string text = "id,modules_in_series,strings_in_parallel,module\n";
  for (const ScaleString& one : plant.strings) {
    text += Said("%s,%d,%d,../type%d.json\n", one.id.c_str(), one.modules, one.strings, one.type);
  }
  return text;
}

std::string TruthText(const ScalePlant& plant) {
  std::string text = "id,fault,power_W\n";
  for (const ScaleString& one : plant.strings) {
    text += Said("%s,%s,%.1f\n", one.id.c_str(), one.fault.c_str(), one.power);
  }
  return text;
}

std::string WriteText(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.flush();
  return file ? "" : "cannot write " + path.string();
}

std::string WriteOnePlant(const ScalePlantsRequest& request, int number) {
  ScalePlant plant = DrawPlant(request.seed, number);
  for (std::size_t i = 0; i < plant.strings.size(); ++i) {
    Random random(SeedOf(request.seed + 5, number * 1000 + static_cast<int>(i)));
    const Sampled curve = CurveOfString(plant.strings[i], plant, &random);
    const Peak peak = PeakOf(curve);
    plant.strings[i].power = peak.imp * peak.vmp;
    plant.strings[i].readings = ReadingsOf(curve, &random);
  }
  const auto folder =
      std::filesystem::path(request.folder) / Said("plant%03d", number);
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  std::string error = WriteText(folder / "strings.csv", PackedPlant(plant));
  if (error.empty()) error = WriteText(folder / "plan.csv", PlanText(plant));
  return error.empty() ? WriteText(folder / "truth.csv", TruthText(plant)) : error;
}

}  // namespace

std::string WriteScalePlants(const ScalePlantsRequest& request) {
  std::error_code failed;
  std::filesystem::create_directories(request.folder, failed);
  for (int t = 0; t < kPlannedTypes; ++t) {
    const auto path = std::filesystem::path(request.folder) / Said("type%d.json", t);
    if (const std::string error = WriteText(path, SheetOf(t)); !error.empty()) return error;
  }
  std::vector<std::string> errors(static_cast<std::size_t>(request.plants));
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int i = next++; i < request.plants; i = next++) {
      errors[static_cast<std::size_t>(i)] = WriteOnePlant(request, i);
    }
  };
  int threads = request.threads;
  if (threads <= 0) threads = static_cast<int>(std::thread::hardware_concurrency());
  std::vector<std::thread> workers;
  for (int t = 0; t < std::max(threads, 1); ++t) workers.emplace_back(work);
  for (std::thread& worker : workers) worker.join();
  for (const std::string& error : errors) {
    if (!error.empty()) return error;
  }
  return "";
}

}  // namespace made
