#include "faults/plan.h"

#include <algorithm>
#include <cmath>

#include "faults/cell.h"

namespace faults {
namespace {

constexpr const char* kNames[kKinds] = {"fwd", "rev", "updown", "dark", "famG", "famGT"};

// Values from 0 to 1, equally spaced or denser towards 1.
std::vector<double> Ramp(int count, bool even) {
  std::vector<double> ramp(count);
  for (int i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / (count - 1);
    ramp[i] = even ? t : 1 - std::pow(1 - t, 1.6) * (1 - 0.15 * t);
  }
  return ramp;
}

// Adds a curve from `low` to `high`, in V of the whole device.
void AddCurve(Setting at, const std::vector<double>& ramp, double low, double high, Plan* plan) {
  for (const double part : ramp) {
    at.voltage = low + part * (high - low);
    plan->settings.push_back(at);
  }
}

double OpenCircuit(const Device& device, double suns, double kelvin) {
  const Cell cell = CellUnder(device, {}, suns, kelvin);
  return device.cells * CellVoltage(cell, 0);
}

void AddOneSweep(const Device& device, bool reverse, Random* random, Plan* plan) {
  const double open = device.cells * device.open_circuit;
  double low = random->Chance(0.3) ? random->Uniform(-0.02, 0.02) * open : 0;
  if (reverse) {
    low = -(device.cells == 1 ? random->Uniform(5, 9.5) : device.cells * random->Uniform(0.4, 2));
  }
  const int count = static_cast<int>(random->LogUniform(reverse ? 40 : 15, 201));
  if (!reverse) {
    AddCurve({}, Ramp(count, plan->even), low, open * random->Uniform(1.003, 1.04), plan);
    return;
  }
  const int behind = count / 3;
  std::vector<double> ramp = Ramp(behind + 1, true);
  ramp.pop_back();
  AddCurve({}, ramp, low, 0, plan);
  AddCurve({}, Ramp(count - behind, plan->even), 0, open * random->Uniform(1.003, 1.03), plan);
}

void AddUpDown(const Device& device, Random* random, Plan* plan) {
  const double open = device.cells * device.open_circuit;
  const int half = static_cast<int>(random->LogUniform(15, 101));
  const std::vector<double> ramp = Ramp(half, plan->even);
  const double top = open * random->Uniform(1.003, 1.04);
  AddCurve({}, ramp, 0, top, plan);
  std::vector<Setting>& all = plan->settings;
  for (int i = half - 1; i >= 0; --i) {
    all.push_back(all[i]);
    all.back().sweep = 1;
  }
  if (random->Chance(0.25)) {  // the first sweep goes down
    std::rotate(all.begin(), all.begin() + half, all.end());
    for (Setting& at : all) at.sweep = 1 - at.sweep;
  }
}

void AddDark(const Device& device, Random* random, Plan* plan) {
  const double open = device.cells * device.open_circuit;
  const int half = static_cast<int>(random->LogUniform(15, 101));
  AddCurve({}, Ramp(half, plan->even), 0, open * random->Uniform(1.003, 1.04), plan);
  Setting dark;
  dark.curve = dark.sweep = 1;
  dark.suns = 0;
  AddCurve(dark, Ramp(half, true), 0, open * random->Uniform(0.97, 1.01), plan);
}

void AddFamily(const Device& device, std::vector<double> suns, std::vector<double> kelvins,
               Random* random, Plan* plan) {
  const int members = static_cast<int>(suns.size() * kelvins.size());
  const int count = static_cast<int>(random->LogUniform(15, std::max(25, 300 / members)));
  const double beyond = random->Uniform(1.003, 1.04);
  Setting at;
  for (const double kelvin : kelvins) {
    for (const double sun : suns) {
      at.suns = sun;
      at.kelvin = kelvin;
      AddCurve(at, Ramp(count, plan->even), 0, beyond * OpenCircuit(device, sun, kelvin), plan);
      ++at.curve;
      at.sweep = at.curve;
    }
  }
}

std::vector<double> Levels(int count, double lowest) {
  std::vector<double> levels(count);
  for (int i = 0; i < count; ++i) {
    const double part = static_cast<double>(i) / (count - 1);
    levels[i] = std::round((lowest + (1 - lowest) * part) * 100) / 100;
  }
  return levels;
}

}  // namespace

const char* Name(Kind kind) { return kNames[static_cast<int>(kind)]; }

std::vector<Kind> KindsCalled(const std::string& name) {
  std::vector<Kind> kinds;
  for (int i = 0; i < kKinds; ++i) {
    if (name == "all" || name == kNames[i]) kinds.push_back(static_cast<Kind>(i));
  }
  return kinds;
}

double Plan::X(double time_s) const {
  const double first = settings.front().time_s;
  return (time_s - first) / (settings.back().time_s - first) - 0.5;
}

double Plan::Rate() const {
  double path = 0;
  for (std::size_t i = 1; i < settings.size(); ++i) {
    path += std::fabs(settings[i].voltage - settings[i - 1].voltage);
  }
  return path / (settings.back().time_s - settings.front().time_s);
}

Plan DrawPlan(Kind kind, const Device& device, Random* random) {
  Plan plan;
  plan.kind = kind;
  plan.even = random->Chance(0.75);
  plan.times = kind == Kind::kUpDown || (random->Chance(0.3) && kind < Kind::kDark);
  switch (kind) {
    case Kind::kForward:
    case Kind::kReverse:
      AddOneSweep(device, kind == Kind::kReverse, random, &plan);
      break;
    case Kind::kUpDown:
      AddUpDown(device, random, &plan);
      break;
    case Kind::kDark:
      AddDark(device, random, &plan);
      break;
    case Kind::kIrradiances:
      AddFamily(device, Levels(4 + random->Index(3), random->Uniform(0.1, 0.25)), {kReferenceK},
                random, &plan);
      break;
    case Kind::kConditions:
      AddFamily(device, Levels(3, random->Uniform(0.15, 0.3)),
                {random->Uniform(285, 298), random->Uniform(308, 318), random->Uniform(328, 343)},
                random, &plan);
      break;
  }
  const double interval = random->LogUniform(1e-4, 0.1);
  for (std::size_t i = 0; i < plan.settings.size(); ++i) plan.settings[i].time_s = i * interval;
  return plan;
}

}  // namespace faults
