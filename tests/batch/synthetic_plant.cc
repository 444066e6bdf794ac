#include "batch/synthetic_plant.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>

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

constexpr ModuleType kType = {/*seed=*/3, /*cells=*/60, /*groups=*/3, /*current=*/9.6,
                              /*open_circuit_V=*/0.655};
constexpr double kCelsius = 273.15;

__attribute__((format(printf, 1, 2))) std::string Text(const char* format, ...) {
  char buffer[400];
  va_list values;
  va_start(values, format);
  std::vsnprintf(buffer, sizeof buffer, format, values);
  va_end(values);
  return buffer;
}

struct Weather {
  double suns, kelvin;
  std::string date;
};

// One inverter per day, one string every 70 seconds around noon of a clear day.
Weather WeatherOf(int place) {
  constexpr int kOfDay = kCombiners * kStringsOfCombiner;
  const int day = place / kOfDay;
  const int minute = (place % kOfDay) * 70 / 60;
  const double hour = 10.5 + minute / 60.0;
  Weather weather;
  weather.suns = (day % 2 == 0 ? 0.96 : 0.91) * std::cos((hour - 13) * 0.26);
  weather.kelvin = kCelsius + 19 + 1.1 * (hour - 10.5) + 27 * weather.suns;
  weather.date = Text("2026-06-%02d %02d:%02d", 16 + day, (630 + minute) / 60, (630 + minute) % 60);
  return weather;
}

std::string IdOf(int place) {
  const int combiner = place / kStringsOfCombiner;
  return Text("elm/inv%02d/comb%02d/str%02d", combiner / kCombiners + 1, combiner % kCombiners + 1,
              place % kStringsOfCombiner + 1);
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

struct KeyPoints {
  double isc, voc, imp, vmp;
  double pmax() const { return imp * vmp; }
};

KeyPoints KeyPointsOf(const Sampled& curve) {
  KeyPoints key{ShortCircuit(curve), OpenCircuit(curve), 0, 0};
  for (int i = 0; i <= 4000; ++i) {
    const double voltage = key.voc * (0.4 + 0.6 * i / 4000), current = curve.CurrentAt(voltage);
    if (voltage * current > key.pmax()) key.imp = current, key.vmp = voltage;
  }
  return key;
}

KeyPoints ModuleAt(double suns, double celsius) {
  Random typical(7);
  return KeyPointsOf(CurveOf(faults::field::DrawOfType(kType, suns, celsius + kCelsius, &typical)));
}

double RatedPower() { return 5 * std::floor(ModuleAt(1, 25).pmax() / 5); }

// A string without a fault, measured by a tracer that charges a capacitor.
StringRig HealthyString(const Weather& weather, Random* random) {
  StringRig rig;
  const double clean = 1 - 0.004 * std::fabs(random->Normal());  // slight soiling
  const double kelvin = weather.kelvin + 0.7 * random->Normal();
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
  return rig;
}

struct Strung {
  std::string id, date;
  double irradiance_Wm2 = 0, temperature_C = 0;  // as shown by the sensors
  faults::field::Readings readings;
  double loss_percent = 0;  // loss of maximum power by the fault
};

Strung Measure(int place, const PlantFault* fault, std::uint64_t seed) {
  Random random(SeedOf(seed, place));
  const Weather weather = WeatherOf(place);
  Strung strung;
  strung.id = IdOf(place);
  strung.date = weather.date;
  StringRig rig = HealthyString(weather, &random);
  faults::field::Rig whole;
  whole.departure = faults::field::DrawDeparture(&random);
  const double missed = random.LogUniform(3e-4, 1e-3);
  const Sampled reference = CurveOf(WholeString(rig));
  SettleDeparture(reference, missed, &whole.departure);
  if (fault != nullptr) fault->apply(&random, &rig);
  whole.module = WholeString(rig);
  whole.sky = rig.sky;
  whole.tracer = rig.tracer;
  faults::field::Lit lit(whole.module);
  strung.loss_percent = 100 * (1 - KeyPointsOf(lit.Whole()).pmax() / KeyPointsOf(reference).pmax());
  strung.readings = Measured(whole, &lit, &random);
  // The sensor is set up anew at each combiner.
  Random sensor(SeedOf(seed, 1'000'000 + place / kStringsOfCombiner));
  const double gain = 1 + 0.004 * sensor.Normal() + 0.006 * random.Normal();
  strung.irradiance_Wm2 = std::round(1000 * weather.suns * gain);
  strung.temperature_C = std::round(10 * (weather.kelvin - kCelsius + random.Normal())) / 10;
  return strung;
}

// Indices of the strings with a fault, in the order of PlantFaults.
std::vector<int> HiddenPlaces(const PlantRequest& request) {
  Random random(SeedOf(request.seed, 2'000'000));
  std::vector<int> places;
  const int faults = static_cast<int>(PlantFaults().size());
  while (static_cast<int>(places.size()) < std::min(faults, request.strings / 4)) {
    const int place = random.Index(request.strings);
    if (std::find(places.begin(), places.end(), place) == places.end()) places.push_back(place);
  }
  return places;
}

std::vector<Strung> MeasureAll(const PlantRequest& request, const std::vector<int>& hidden) {
  std::vector<Strung> strings(request.strings);
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int i = next++; i < request.strings; i = next++) {
      const auto found = std::find(hidden.begin(), hidden.end(), i);
      const PlantFault* fault =
          found == hidden.end() ? nullptr : &PlantFaults()[found - hidden.begin()];
      strings[i] = Measure(i, fault, request.seed);
    }
  };
  int threads = request.threads;
  if (threads <= 0) threads = static_cast<int>(std::thread::hardware_concurrency());
  std::vector<std::thread> workers;
  for (int t = 0; t < std::max(threads, 1); ++t) workers.emplace_back(work);
  for (std::thread& worker : workers) worker.join();
  return strings;
}

std::string ListOf(const std::vector<double>& values, const char* format) {
  std::string text;
  for (const double value : values) {
    if (!text.empty()) text += ' ';
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, format, value);
    text += buffer;
  }
  return text;
}

constexpr int kCells = kModules * kType.cells;
constexpr int kDiodes = kModules * kType.groups;

std::string Packed(const std::vector<Strung>& strings, double rated_W) {
  std::string text =
      "id,date,irradiance_Wm2,temperature_C,cells_in_series,bypass_diodes,rated_power_W,voltage_V,"
      "current_A\n";
  for (const Strung& one : strings) {
    text += Text("%s,%s,%.0f,%.1f,%d,%d,%.0f,", one.id.c_str(), one.date.c_str(),
                 one.irradiance_Wm2, one.temperature_C, kCells, kDiodes, kModules * rated_W);
    text +=
        ListOf(one.readings.voltage, "%.2f") + "," + ListOf(one.readings.current, "%.3f") + "\n";
  }
  return text;
}

std::string Trace(const Strung& one) {
  std::string text = Text(
      "String tracer,\nDate,%s\nMeasured Irradiance (W/m^2),%.0f\nMeasured Cell Temp (C),%.1f\n"
      "Number of cells,%d\n\nVoltage (V),Current (A)\n",
      one.date.c_str(), one.irradiance_Wm2, one.temperature_C, kCells);
  for (std::size_t k = 0; k < one.readings.voltage.size(); ++k) {
    text += Text("%.2f,%.3f\n", one.readings.voltage[k], one.readings.current[k]);
  }
  return text;
}

std::string TruthOf(const std::vector<Strung>& strings, const std::vector<int>& hidden) {
  std::string text = "id,fault,accepted,shows_in,loss_percent,words\n";
  for (std::size_t k = 0; k < hidden.size(); ++k) {
    const PlantFault& fault = PlantFaults()[k];
    const Strung& one = strings[hidden[k]];
    text += Text("%s,%s,%s,%s,%.2f,%s\n", one.id.c_str(), fault.name, fault.accepted,
                 fault.shows_in, one.loss_percent, fault.words);
  }
  return text;
}

// Data sheet of one module as JSON, with temperature coefficients between 25 and 50 C.
std::string ModuleJson(double rated_W) {
  const KeyPoints cool = ModuleAt(1, 25), warm = ModuleAt(1, 50);
  const auto percent = [](double one, double other) { return 100 * (other / one - 1) / 25; };
  return Text(
             "{\n  \"name\": \"Elm 60\",\n  \"technology\": \"mono-Si\",\n"
             "  \"cells_in_series\": %d,\n  \"bypass_diodes\": %d,\n  \"modules_in_series\": %d,\n"
             "  \"rated_power_W\": %.0f,\n  \"short_circuit_current_A\": %.2f,\n"
             "  \"open_circuit_voltage_V\": %.1f,\n  \"max_power_current_A\": %.2f,\n"
             "  \"max_power_voltage_V\": %.1f,\n",
             kType.cells, kType.groups, kModules, rated_W, cool.isc, cool.voc, cool.imp, cool.vmp) +
         Text(
             "  \"alpha_sc_percent_K\": %.3f,\n  \"beta_oc_percent_K\": %.3f,\n"
             "  \"gamma_pmp_percent_K\": %.3f\n}\n",
             percent(cool.isc, warm.isc), percent(cool.voc, warm.voc),
             percent(cool.pmax(), warm.pmax()));
}

std::string Write(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.flush();
  return file ? "" : "cannot write " + path;
}

std::string WriteTree(const PlantRequest& request, const std::vector<Strung>& strings) {
  for (const Strung& one : strings) {
    const std::filesystem::path path = std::filesystem::path(request.tree) / one.id;
    std::error_code failed;
    std::filesystem::create_directories(path.parent_path(), failed);
    std::string error = Write(path.string() + ".csv", Trace(one));
    if (error.empty() && request.sidecars) {
      error = Write(path.string() + ".json",
                    Text("{\"cells_in_series\": %d, \"bypass_diodes\": %d}\n", kCells, kDiodes));
    }
    if (!error.empty()) return error;
  }
  return "";
}

}  // namespace

std::string WritePlant(const PlantRequest& request) {
  const double rated_W = RatedPower();
  const std::vector<int> hidden = HiddenPlaces(request);
  const std::vector<Strung> strings = MeasureAll(request, hidden);
  std::string error;
  const auto write = [&](const std::string& path, const auto& text) {
    if (error.empty() && !path.empty()) error = Write(path, text());
  };
  write(request.packed, [&] { return Packed(strings, rated_W); });
  write(request.truth, [&] { return TruthOf(strings, hidden); });
  write(request.module, [&] { return ModuleJson(rated_W); });
  if (error.empty() && !request.tree.empty()) error = WriteTree(request, strings);
  return error;
}

}  // namespace made
