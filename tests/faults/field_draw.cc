#include "faults/field_draw.h"

#include <algorithm>
#include <cmath>

namespace faults::field {
namespace {

constexpr double kVoltPerKelvin = 1.380649e-23 / 1.602176634e-19;
constexpr double kStandardKelvin = 298.15;
constexpr double kGap_eV = 1.12;

struct Layout {
  int cells;
  int groups;
  bool half_cut;
  double current_low;  // A at 1000 W/m2, of the module
  double current_high;
  double open_low;  // V of a cell
  double open_high;
};

constexpr Layout kLayouts[] = {
    {36, 2, false, 2.3, 8.6, 0.59, 0.63},  {48, 2, false, 7.5, 9.5, 0.61, 0.68},
    {60, 3, false, 8.0, 10.0, 0.61, 0.70}, {60, 3, false, 8.0, 10.0, 0.61, 0.70},
    {72, 3, false, 5.0, 9.8, 0.60, 0.70},  {72, 3, false, 5.0, 9.8, 0.60, 0.70},
    {96, 3, false, 5.7, 6.5, 0.67, 0.73},  {96, 4, false, 5.7, 6.5, 0.67, 0.74},
    {54, 3, true, 12.5, 14.5, 0.67, 0.72}, {60, 3, true, 10.0, 18.0, 0.66, 0.72},
    {72, 3, true, 10.0, 14.0, 0.66, 0.72},
};

double Warmed(double saturation_25, double kelvin, double ideality) {
  const double heat = kGap_eV / kVoltPerKelvin * (1 / kStandardKelvin - 1 / kelvin);
  return saturation_25 * std::exp((3 * std::log(kelvin / kStandardKelvin) + heat) / ideality);
}

void DrawReverse(double current, Random* random, Cell* cell) {
  const int law = random->Index(3);
  cell->reverse = static_cast<Reverse>(law);
  cell->reverse_A = current;
  if (cell->reverse == Reverse::kShuntBreakdown) {
    cell->reverse_V = random->Uniform(12, 25);
    cell->reverse_exponent = random->Uniform(3, 4);
    cell->reverse_factor = random->LogUniform(0.05, 0.5);
  } else if (cell->reverse == Reverse::kSoftPower) {
    cell->reverse_V = random->Uniform(2.5, 9);
    cell->reverse_exponent = random->Uniform(2.5, 4.2);
  } else {
    cell->reverse_V = random->Uniform(9, 22);
    cell->reverse_exponent = random->Uniform(4, 9);
  }
}

// The typical cell at the light and temperature of the module.
Cell DrawCell(double current_stc, bool two_diodes, const Make& make, Random* random) {
  const double thermal = kVoltPerKelvin * kStandardKelvin;
  Cell cell;
  cell.kelvin = make.kelvin;
  cell.photocurrent = current_stc * make.suns * (1 + 5e-4 * (make.kelvin - kStandardKelvin));
  cell.diffusion_ideality = random->Uniform(1.0, two_diodes ? 1.15 : 1.35);
  const double part = two_diodes ? random->LogUniform(0.004, 0.2) : 0;  // share at open circuit
  const double open = make.open_circuit_V;
  const double n1 = cell.diffusion_ideality;
  const double n2 = random->Chance(0.7) ? 2 : random->Uniform(2.2, 3);
  cell.recombination_ideality = n2;
  cell.diffusion_A =
      Warmed((1 - part) * current_stc / std::expm1(open / (n1 * thermal)), make.kelvin, n1);
  cell.recombination_A =
      Warmed(part * current_stc / std::expm1(open / (n2 * thermal)), make.kelvin, n2);
  cell.shunt_S = current_stc / open * random->LogUniform(2e-4, 8e-3);
  cell.series_ohm = random->Uniform(0.012, 0.055) / current_stc;
  DrawReverse(current_stc, random, &cell);
  return cell;
}

// Standard deviations of the parameters between the cells of one module.
struct Spread {
  double light, diffusion, recombination, shunt, series, kelvin, reverse;
};

Spread DrawSpread(Random* random) {
  return {random->Uniform(0.001, 0.003), random->Uniform(0.02, 0.10), random->Uniform(0.1, 0.4),
          random->Uniform(0.2, 0.7),     random->Uniform(0.01, 0.05), random->Uniform(0.1, 0.8),
          random->Uniform(0.01, 0.05)};
}

// Normal draw clamped at 2.5 standard deviations; larger deviations are faults.
double Usual(Random* random) { return std::clamp(random->Normal(), -2.5, 2.5); }

Cell Varied(const Cell& like, const Spread& spread, Random* random) {
  Cell cell = like;
  cell.photocurrent *= 1 + spread.light * Usual(random);
  cell.diffusion_A *= std::exp(spread.diffusion * Usual(random));
  cell.recombination_A *= std::exp(spread.recombination * Usual(random));
  cell.shunt_S *= std::exp(spread.shunt * Usual(random));
  cell.series_ohm *= 1 + spread.series * Usual(random);
  cell.reverse_V *= 1 + spread.reverse * Usual(random);
  const double warmer = spread.kelvin * Usual(random);
  const double heat = kGap_eV / kVoltPerKelvin * warmer / (cell.kelvin * cell.kelvin);
  cell.kelvin += warmer;
  cell.diffusion_A *= std::exp(heat / cell.diffusion_ideality);
  cell.recombination_A *= std::exp(heat / cell.recombination_ideality);
  return cell;
}

BypassDiode DrawDiode(double current_stc, double kelvin, Random* random) {
  const double drop = random->Uniform(0.40, 0.60);
  const double ohmic = random->Uniform(0.1, 0.25) * drop;
  BypassDiode diode;
  diode.scale_V = random->Uniform(1.02, 1.15) * kVoltPerKelvin * kelvin;
  diode.series_ohm = ohmic / current_stc;
  diode.saturation_A = current_stc * std::exp(-(drop - ohmic) / diode.scale_V);
  return diode;
}

struct Wiring {
  int cells, groups, chains;
};

Module Assemble(const Wiring& wiring, const Cell& like, const Spread& spread,
                const BypassDiode& diode, Random* random) {
  Module module;
  for (int g = 0; g < wiring.groups; ++g) {
    Group group;
    group.diode = diode;
    group.diode.saturation_A *= std::exp(0.2 * Usual(random));
    group.chains.resize(wiring.chains);
    for (auto& chain : group.chains) {
      for (int c = 0; c < wiring.cells / wiring.groups; ++c) {
        chain.push_back(Varied(like, spread, random));
      }
    }
    module.groups.push_back(group);
  }
  return module;
}

}  // namespace

Module DrawOfType(const ModuleType& type, double suns, double kelvin, Random* random) {
  Random common(type.seed);
  Make make;
  make.suns = suns;
  make.kelvin = kelvin;
  make.open_circuit_V = type.open_circuit_V;
  const Cell like = DrawCell(type.current, true, make, &common);
  const Spread spread = DrawSpread(&common);
  const BypassDiode diode = DrawDiode(type.current, kelvin, &common);
  return Assemble({type.cells, type.groups, 1}, like, spread, diode, random);
}

Drawn DrawModule(Uniformity uniformity, Random* random) {
  const Layout& layout = kLayouts[random->Index(static_cast<int>(std::size(kLayouts)))];
  Drawn drawn;
  Make& make = drawn.make;
  make.half_cut = layout.half_cut;
  make.suns = random->Uniform(0.25, 1.12);
  make.kelvin = 273.15 + random->Uniform(5, 30) + 30 * make.suns * random->Unit();
  make.open_circuit_V = random->Uniform(layout.open_low, layout.open_high);
  const double current = random->Uniform(layout.current_low, layout.current_high);
  const int chains = layout.half_cut ? 2 : 1;
  const Cell like =
      DrawCell(current / chains, uniformity != Uniformity::kSingleDiode, make, random);
  const Spread spread = uniformity == Uniformity::kEveryCellItsOwn ? DrawSpread(random) : Spread{};
  BypassDiode diode = DrawDiode(current, make.kelvin, random);
  if (uniformity != Uniformity::kEveryCellItsOwn) diode.saturation_A *= 1e-5;  // of silicon
  drawn.module = Assemble({layout.cells, layout.groups, chains}, like, spread, diode, random);
  return drawn;
}

}  // namespace faults::field
