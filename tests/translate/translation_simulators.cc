#include "translate/translation_simulators.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "faults/field_case.h"
#include "lyrefit/base/constants.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/model/translation.h"

namespace shown {
namespace {

namespace field = faults::field;
using faults::Random;
using faults::SeedOf;

constexpr double kStandard_K = 298.15;
constexpr double kAlpha = 5e-4;  // temperature coefficient of Isc of the field cells, 1/K

field::ModuleType DrawType(std::uint64_t seed) {
  Random random(SeedOf(seed, 1));
  field::ModuleType type;
  type.seed = SeedOf(seed, 2);
  constexpr int kCells[] = {36, 60, 60, 72};
  type.cells = kCells[random.Index(4)];
  type.groups = type.cells == 36 ? 2 : 3;
  type.current = random.Uniform(5, 11);
  type.open_circuit_V = random.Uniform(0.60, 0.72);
  return type;
}

// The module of a type under given conditions; its cells do not depend on the conditions. `alike`:
// all cells are equal.
field::Module ModuleOf(const field::ModuleType& type, std::uint64_t seed, bool alike, double suns,
                       double kelvin) {
  Random random(SeedOf(seed, 3));
  field::Module module = field::DrawOfType(type, suns, kelvin, &random);
  if (!alike) return module;
  const field::Cell first = module.groups[0].chains[0][0];
  for (field::Group& group : module.groups) {
    for (auto& chain : group.chains) std::fill(chain.begin(), chain.end(), first);
  }
  return module;
}

// Copies the shunt conductances: in this simulator they do not depend on the light, with or without
// a fault.
void TakeShunts(const field::Module& from, field::Module* to) {
  for (std::size_t g = 0; g < from.groups.size(); ++g) {
    for (std::size_t k = 0; k < from.groups[g].chains.size(); ++k) {
      for (std::size_t c = 0; c < from.groups[g].chains[k].size(); ++c) {
        to->groups[g].chains[k][c].shunt_S = from.groups[g].chains[k][c].shunt_S;
      }
    }
  }
}

lyrefit::KeyPoints KeyOf(const field::Module& module, const field::Departure& departure) {
  const field::Sampled curve = field::CurveOf(module);
  const double isc = field::ShortCircuit(curve), voc = field::OpenCircuit(curve);
  std::vector<double> voltage_V, current_A;
  constexpr int kSteps = 8000;
  for (int i = 0; i <= kSteps; ++i) {
    const double u = 1.005 * i / kSteps, plain = curve.CurrentAt(u * voc);
    voltage_V.push_back(u * voc);
    current_A.push_back(plain + isc * departure.At(u, 1 - plain / isc));
  }
  return lyrefit::FindKeyPoints(voltage_V, current_A);
}

lyrefit::StatedCoefficients DataSheet(const field::ModuleType& type, std::uint64_t seed,
                                      bool alike) {
  const auto voc = [&](double kelvin) {
    return field::OpenCircuit(field::CurveOf(ModuleOf(type, seed, alike, 1, kelvin)));
  };
  lyrefit::StatedCoefficients stated;
  stated.alpha_A_K = kAlpha * type.current;
  stated.beta_V_K = (voc(kStandard_K + 10) - voc(kStandard_K - 10)) / 20;
  return stated;
}

lyrefit::IvCurve CurveOfReadings(const field::Readings& readings, const field::Module& module,
                                 double suns, double kelvin) {
  lyrefit::IvCurve curve;
  curve.name = "made";
  curve.as_is = true;
  curve.voltage_V = readings.voltage;
  curve.current_A = readings.current;
  curve.conditions = {kelvin, 1000 * suns, module.CellsInSeries(), 1};
  curve.notes.technology = "c-Si";
  curve.notes.bypass_diodes = static_cast<int>(module.groups.size());
  return curve;
}

// Uniform ageing: an additional shunt on every cell, or an additional series resistance.
void Age(const std::string& kind, const field::ModuleType& type, Random* random,
         field::Module* module) {
  const double cell_ohm = type.open_circuit_V / type.current;
  const double leak = 1 / (cell_ohm * random->LogUniform(2.5, 8));
  const double more_ohm = cell_ohm * random->Uniform(0.05, 0.15);
  for (field::Group& group : module->groups) {
    for (auto& chain : group.chains) {
      for (field::Cell& cell : chain) {
        if (kind == "low_shunt") cell.shunt_S += leak;
        if (kind == "high_series") cell.series_ohm += more_ohm;
      }
    }
  }
}

const field::Fault* Called(const std::vector<field::Fault>& faults, const std::string& kind) {
  for (const field::Fault& fault : faults) {
    if (kind == fault.name) return &fault;
  }
  return nullptr;
}

SyntheticCase MakeCells(const std::string& kind, bool alike, double suns, double kelvin,
                        std::uint64_t seed) {
  const field::ModuleType type = DrawType(seed);
  field::Rig rig;
  rig.module = ModuleOf(type, seed, alike, suns, kelvin);
  field::Rig there;  // under standard conditions
  there.module = ModuleOf(type, seed, alike, 1, kStandard_K);
  Random random(SeedOf(seed, 4));
  rig.tracer = field::DrawTracer(field::Bench::kField, &random);
  if (!alike) {
    rig.departure = field::DrawDeparture(&random);
    field::SettleDeparture(field::CurveOf(rig.module), random.LogUniform(5e-4, 2e-3),
                           &rig.departure);
    rig.sky.wander = field::DrawWander(random.LogUniform(2e-4, 2e-3), &random);
  }
  field::Truth truth;
  if (const field::Fault* fault = Called(field::DeviceFaults(), kind)) {
    Random one(SeedOf(seed, 5)), two(SeedOf(seed, 5));
    fault->apply(&one, &rig, &truth);
    fault->apply(&two, &there, &truth);
  } else if (const field::Fault* spoilt = Called(field::SweepFaults(), kind)) {
    spoilt->apply(&random, &rig, &truth);
  } else {
    Random one(SeedOf(seed, 5)), two(SeedOf(seed, 5));
    Age(kind, type, &one, &rig.module);
    Age(kind, type, &two, &there.module);
  }
  TakeShunts(rig.module, &there.module);
  field::Lit lit(rig.module);
  SyntheticCase made;
  made.curve = CurveOfReadings(field::Measured(rig, &lit, &random), rig.module, suns, kelvin);
  made.coefficients = DataSheet(type, seed, alike);
  made.stc = KeyOf(there.module, rig.departure);
  return made;
}

SyntheticCase MakePvsyst(double suns, double kelvin, std::uint64_t seed) {
  Random random(SeedOf(seed, 6));
  lyrefit::TranslationSpec spec;
  spec.law = lyrefit::TranslationLaw::kPvsyst;
  spec.shunt = lyrefit::ShuntLaw::kExponential;
  spec.cells_in_series = 60;
  const lyrefit::Translation law = *lyrefit::MakeTranslation(spec);
  std::vector<double> p(law.size(), 0);
  p[law.photocurrent] = random.Uniform(5, 11);
  p[law.n] = random.Uniform(0.95, 1.2);
  p[law.saturation_current] =
      p[law.photocurrent] * std::exp(-random.Uniform(0.60, 0.70) / (p[law.n] * 0.025693));
  p[law.resistance_series] = random.Uniform(0.01, 0.04) * 60 * 0.64 / p[law.photocurrent];
  p[law.resistance_shunt] = random.LogUniform(20, 150) * 60 * 0.64 / p[law.photocurrent];
  p[law.resistance_shunt_dark] = random.Uniform(3, 6) * p[law.resistance_shunt];
  p[law.shunt_exponent] = 5.5;
  p[law.alpha_sc] = kAlpha * p[law.photocurrent];
  p[law.n_slope] = random.Uniform(-8e-4, 2e-4);
  p[law.bandgap] = 1.121;
  const auto key = [&](double g, double at_K) {
    const lyrefit::TranslatedDevice at = lyrefit::TranslateTo(law, p, g, at_K);
    return lyrefit::ModelKeyPoints(at.device, at.parameters.data());
  };
  SyntheticCase made;
  made.curve.name = "made";
  made.curve.conditions = {kelvin, 1000 * suns, 60, 1};
  const lyrefit::TranslatedDevice at = lyrefit::TranslateTo(law, p, 1000 * suns, kelvin);
  const double voc = key(1000 * suns, kelvin).open_circuit_voltage_V;
  constexpr int kPoints = 100;
  const double noise_A = 3e-4 * p[law.photocurrent];
  for (int i = 0; i < kPoints; ++i) {
    const double v = 1.01 * voc * i / (kPoints - 1);
    made.curve.voltage_V.push_back(v);
    made.curve.current_A.push_back(
        lyrefit::SolveOperatingPoint(at.device, at.parameters.data(), v).current_A +
        noise_A * random.Normal());
  }
  made.coefficients.alpha_A_K = p[law.alpha_sc];
  made.coefficients.beta_V_K = (key(1000, kStandard_K + 10).open_circuit_voltage_V -
                                key(1000, kStandard_K - 10).open_circuit_voltage_V) /
                               20;
  made.stc = key(1000, kStandard_K);
  return made;
}

}  // namespace

std::vector<std::string> Worlds() { return {"PVsyst", "two diodes", "cells"}; }

SyntheticCase MakeReferenceSweeps(const std::string& world, const Light& light,
                                  std::uint64_t seed) {
  Random random(SeedOf(seed, 7));
  const double suns = random.Uniform(light.lowest_W_m2, light.highest_W_m2) / 1000;
  const double kelvin = 273.15 + random.Uniform(5, 30) + 30 * suns * random.Unit();
  if (world == "PVsyst") return MakePvsyst(suns, kelvin, seed);
  return MakeCells("reference", world == "two diodes", suns, kelvin, seed);
}

std::vector<std::string> FaultKinds() {
  std::vector<std::string> kinds = {"reference", "low_shunt", "high_series"};
  for (const auto* faults : {&field::DeviceFaults(), &field::SweepFaults()}) {
    for (const field::Fault& fault : *faults) kinds.push_back(fault.name);
  }
  return kinds;
}

SyntheticCase MakeFaulty(const std::string& kind, double irradiance_W_m2, double temperature_C,
                         std::uint64_t seed) {
  return MakeCells(kind, false, irradiance_W_m2 / 1000, temperature_C + 273.15, seed);
}

}  // namespace shown
