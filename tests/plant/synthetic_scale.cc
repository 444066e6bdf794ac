#include "plant/synthetic_scale.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <vector>

#include "faults/field_draw.h"
#include "faults/field_tracer.h"
#include "faults/for_each.h"
#include "faults/random.h"
#include "plant/synthetic_scale_plant.h"

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

__attribute__((format(printf, 1, 2))) std::string Said(const char* format, ...) {
  char buffer[500];
  va_list values;
  va_start(values, format);
  std::vsnprintf(buffer, sizeof buffer, format, values);
  va_end(values);
  return buffer;
}

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
    Group& group =
        (*modules)[static_cast<std::size_t>(s / 2)].groups[static_cast<std::size_t>(s % 2)];
    const double light = random->Uniform(0.3, 0.75);
    for (Cell& cell : group.chains[0]) cell.photocurrent *= light;
  }
  for (std::size_t m = 0; one.degraded && m < modules->size() / 2; ++m) {
    const double strength =
        0.15 * (1 - 2.0 * static_cast<double>(m) / static_cast<double>(modules->size()));
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
    modules.push_back(
        faults::field::DrawOfType(type, one.suns * one.clean * power_class * plant.current_class,
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

std::string PackedPlant(const ScalePlant& plant) {
  std::string text = "id,irradiance_Wm2,temperature_C,cells_in_series,voltage_V,current_A\n";
  for (const ScaleString& one : plant.strings) {
    text +=
        Said("%s,%.0f,%.1f,%d,", one.id.c_str(), 1000 * one.suns * one.light_reading,
             one.kelvin - kZeroCelsius + one.kelvin_reading, one.modules * kTypes[one.type].cells);
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
  ScalePlant plant = DrawScalePlant(request.seed, number);
  for (std::size_t i = 0; i < plant.strings.size(); ++i) {
    Random random(SeedOf(request.seed + 5, number * 1000 + static_cast<int>(i)));
    const Sampled curve = CurveOfString(plant.strings[i], plant, &random);
    const Peak peak = PeakOf(curve);
    plant.strings[i].power = peak.imp * peak.vmp;
    plant.strings[i].readings = ReadingsOf(curve, &random);
  }
  const auto folder = std::filesystem::path(request.folder) / Said("plant%03d", number);
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
  faults::ForEach(request.plants, request.threads,
                  [&](int i) { errors[static_cast<std::size_t>(i)] = WriteOnePlant(request, i); });
  for (const std::string& error : errors) {
    if (!error.empty()) return error;
  }
  return "";
}

}  // namespace made
