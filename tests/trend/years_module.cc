#include "trend/years_module.h"

#include <algorithm>
#include <cmath>

namespace years {
namespace {

using faults::Random;
using faults::field::BypassDiode;
using faults::field::Cell;
using faults::field::Law;
using faults::field::Point;
using faults::field::Reverse;

constexpr double kVoltPerKelvin = 1.380649e-23 / 1.602176634e-19;
constexpr double kStandardKelvin = 298.15;
constexpr double kGap_eV = 1.12;
constexpr double kShort_ohm = 3e-3;  // of a failed bypass diode

double Usual(Random* random) { return std::clamp(random->Normal(), -2.5, 2.5); }

// Logarithm of the growth of a saturation current with ideality 1.
double Heat(double kelvin) {
  return 3 * std::log(kelvin / kStandardKelvin) +
         kGap_eV / kVoltPerKelvin * (1 / kStandardKelvin - 1 / kelvin);
}

Cell DrawTypicalCell(Random* random) {
  const double thermal = kVoltPerKelvin * kStandardKelvin;
  const double current = random->Uniform(8.6, 10.2), open = random->Uniform(0.625, 0.675);
  const double part = random->LogUniform(0.01, 0.08);  // recombination at open circuit
  Cell cell;
  cell.kelvin = kStandardKelvin;
  cell.photocurrent = current;
  cell.diffusion_ideality = random->Uniform(1.0, 1.06);
  cell.recombination_ideality = 2;
  cell.diffusion_A = (1 - part) * current / std::expm1(open / (cell.diffusion_ideality * thermal));
  cell.recombination_A = part * current / std::expm1(open / (2 * thermal));
  cell.shunt_S = current / open * random->LogUniform(5e-4, 4e-3);
  cell.series_ohm = random->Uniform(0.03, 0.055) / current;
  cell.reverse = Reverse::kShuntBreakdown;
  cell.reverse_V = random->Uniform(12, 20);
  cell.reverse_exponent = random->Uniform(3, 4);
  cell.reverse_factor = random->LogUniform(0.05, 0.3);
  cell.reverse_A = current;
  return cell;
}

// Voltage of a cell by Newton steps from a junction voltage nearby. Falls back to the bracketed
// search of the cell where they do not settle.
Point CellAtCurrent(const Cell& cell, double current, double* junction_V) {
  constexpr double kLongest_V = 0.04, kConducts_V = 0.55;
  double v = *junction_V;
  for (int i = 0; i < 12; ++i) {
    const Law law = AtJunctionVoltage(cell, v);
    double step = (current - law.current) / law.slope;
    step = std::min(step, std::max(kLongest_V, kConducts_V - v));
    v += step;
    if (v < -0.8 * cell.reverse_V) break;
    if (std::fabs(step) > 1e-7) continue;
    *junction_V = v;  // the step is quadratic: what is left is far below 1e-12 V
    return {current, v - current * cell.series_ohm, 1 / law.slope - cell.series_ohm};
  }
  const Point exact = AtCurrent(cell, current);
  *junction_V = exact.voltage + current * cell.series_ohm;
  return exact;
}

}  // namespace

Design DrawDesign(Random* random) {
  Design design;
  const Cell like = DrawTypicalCell(random);
  const double light = random->Uniform(0.001, 0.003), diffusion = random->Uniform(0.02, 0.08);
  const double recombination = random->Uniform(0.1, 0.3), shunt = random->Uniform(0.2, 0.6);
  const double series = random->Uniform(0.01, 0.05), warm = random->Uniform(0.2, 1.0);
  double mean = 0, mean_K = 0;
  for (int c = 0; c < kClasses; ++c) {
    Cell& cell = design.cells[c] = like;
    cell.photocurrent *= 1 + light * Usual(random);
    cell.diffusion_A *= std::exp(diffusion * Usual(random));
    cell.recombination_A *= std::exp(recombination * Usual(random));
    cell.shunt_S *= std::exp(shunt * Usual(random));
    cell.series_ohm *= 1 + series * Usual(random);
    design.warmer[c] = warm * Usual(random);
    design.stress[c] = random->Uniform(-0.7, 0.7);
    mean += design.stress[c] / kClasses;
    mean_K += design.warmer[c] / kClasses;
  }
  for (double& stress : design.stress) stress -= mean;
  for (double& kelvin : design.warmer) kelvin -= mean_K;
  for (BypassDiode& diode : design.diodes) {
    const double drop = random->Uniform(0.40, 0.60), ohmic = random->Uniform(0.1, 0.25) * drop;
    diode.scale_V = random->Uniform(1.02, 1.15) * kVoltPerKelvin * kStandardKelvin;
    diode.series_ohm = ohmic / like.photocurrent;
    diode.saturation_A = like.photocurrent * std::exp(-(drop - ohmic) / diode.scale_V);
  }
  design.series_per_kelvin = random->Uniform(0, 0.0015);
  return design;
}

double SeriesOhm(const Design& design) {
  double sum = 0;
  for (const Cell& cell : design.cells) sum += kCellsOfClass * cell.series_ohm;
  return sum;
}

double ShuntOhm(const Design& design) {
  double sum = 0;
  for (const Cell& cell : design.cells) sum += kCellsOfClass / cell.shunt_S;
  return sum;
}

double Recombination_A(const Design& design) {
  double sum = 0;
  for (const Cell& cell : design.cells) sum += cell.recombination_A / kClasses;
  return sum;
}

LitModule::LitModule(const Design& design, const State& state, double suns, double kelvin)
    : cells_(design.cells),
      diodes_(design.diodes),
      shorted_(state.shorted),
      covered_(state.covered) {
  const double module_kelvin = kelvin - kStandardKelvin;
  smallest_ = 1e300;
  for (int c = 0; c < kClasses; ++c) {
    Cell& cell = cells_[c];
    const double uneven = state.uneven ? design.stress[c] : 0;
    cell.kelvin = kelvin + suns * design.warmer[c];
    const double heat = Heat(cell.kelvin);
    cell.photocurrent *= suns * state.light * (state.covered ? state.cover[c] : 1) *
                         (1 + 5e-4 * (cell.kelvin - kStandardKelvin));
    cell.diffusion_A *= std::exp(heat / cell.diffusion_ideality);
    cell.recombination_A *= std::exp(heat / cell.recombination_ideality) *
                            (1 + (state.recombination - 1) * (1 + uneven));
    cell.shunt_S *= 1 + (state.shunt - 1) * (1 + uneven);
    cell.series_ohm *= state.series;
    cell.series_ohm += state.series_ohm / kCells;
    cell.series_ohm *= 1 + design.series_per_kelvin * module_kelvin;
    junction_V_[c] = 0.5;
    largest_ = std::max(largest_, cell.photocurrent);
    if (c / (kClasses / kGroups) != shorted_) smallest_ = std::min(smallest_, cell.photocurrent);
  }
  for (BypassDiode& diode : diodes_) {  // Schottky: a barrier of 0.7 eV
    const double ratio = kelvin / kStandardKelvin;
    diode.scale_V *= ratio;
    diode.saturation_A *=
        ratio * ratio * std::exp(0.7 / kVoltPerKelvin * (1 / kStandardKelvin - 1 / kelvin));
  }
}

Point LitModule::AtCurrentOfChain(int group, double current, double light) {
  constexpr int kOfGroup = kClasses / kGroups;
  Point sum{current, 0, 0};
  for (int c = group * kOfGroup; c < (group + 1) * kOfGroup; ++c) {
    const double dark = cells_[c].photocurrent;
    cells_[c].photocurrent *= light;
    const Point own = CellAtCurrent(cells_[c], current, &junction_V_[c]);
    cells_[c].photocurrent = dark;
    sum.voltage += kCellsOfClass * own.voltage;
    sum.slope += kCellsOfClass * own.slope;
  }
  return sum;
}

// Splits the current between the chain and the bypass diode (or its short) by bracketed Newton
// steps on the sum of chain voltage and diode drop, which rises with the current of the diode.
Point LitModule::AtCurrentOfGroup(int group, double current, double light) {
  const bool shorted = group == shorted_;
  const BypassDiode& diode = diodes_[group];
  const double saturation = diode.saturation_A;
  Point chain = AtCurrentOfChain(group, current, light);
  if (!shorted && chain.voltage > 0.3) {  // the diode blocks, with its saturation current
    return {current, chain.voltage + saturation * chain.slope, chain.slope};
  }
  double low = shorted ? current - 1.02 * largest_ * light : -saturation * (1 - 1e-12);
  double high = std::max(current, 0.0) + saturation;
  double through = std::clamp(current - 0.999 * smallest_ * light, low, high);
  double resistance = 0;
  for (int i = 0; i < 100; ++i) {
    chain = AtCurrentOfChain(group, current - through, light);
    const double inside = through + saturation;
    const double drop =
        shorted ? through * kShort_ohm
                : diode.scale_V * std::log(inside / saturation) + diode.series_ohm * through;
    resistance = shorted ? kShort_ohm : diode.scale_V / inside + diode.series_ohm;
    const double off = chain.voltage + drop;
    (off > 0 ? high : low) = through;
    double next = through - off / (resistance - chain.slope);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double step = std::fabs(next - through);
    through = next;
    if (step < 1e-10 * largest_ || std::fabs(off) < 1e-10) break;
  }
  return {current, chain.voltage, chain.slope * resistance / (resistance - chain.slope)};
}

Point LitModule::AtCurrent(double current, double light) {
  Point sum{current, 0, 0};
  for (int g = 0; g < kGroups; ++g) {
    const Point own = AtCurrentOfGroup(g, current, light);
    sum.voltage += own.voltage;
    sum.slope += own.slope;
  }
  return sum;
}

Point LitModule::AtVoltage(double voltage, double light, double guess) {
  double low = -largest_ * light, high = 1.1 * largest_ * light;
  double current = std::clamp(guess, low, high), slope = -1;
  for (int i = 0; i < 80; ++i) {
    const Point at = AtCurrent(current, light);
    const double off = at.voltage - voltage;
    (off > 0 ? low : high) = current;
    double next = current - off / at.slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double step = std::fabs(next - current);
    current = next;
    slope = at.slope;
    if (step < 1e-6 * largest_) break;
  }
  return {current, voltage, slope};
}

// The highest power between two currents with one peak between them: Illinois steps on its slope.
Operating LitModule::Peak(double low, double high) {
  const auto slope = [&](double current, Operating* at) {
    const Point point = AtCurrent(current);
    *at = {current, point.voltage};
    return point.voltage + current * point.slope;
  };
  Operating best, now;
  double at_low = slope(low, &best), at_high = slope(high, &now);
  if (now.power() > best.power()) best = now;
  if (at_low < 0) {  // a strong shunt
    high = low, at_high = at_low;
    at_low = slope(low = 0, &now);
  }
  for (int i = 0; i < 40 && at_low > 0 && at_high < 0 && high - low > 1e-5 * largest_; ++i) {
    double middle = low + (high - low) * at_low / (at_low - at_high);
    if (i % 3 == 2) middle = 0.5 * (low + high);
    const double there = slope(middle, &now);
    if (now.power() > best.power()) best = now;
    if (std::fabs(there) < 1e-4 * now.voltage) break;
    if (there > 0) {
      low = middle, at_low = there, at_high *= 0.5;
    } else {
      high = middle, at_high = there, at_low *= 0.5;
    }
  }
  return best;
}

Operating LitModule::MaximumPower() {
  if (!covered_) return Peak(0.75 * smallest_, 0.995 * smallest_);
  constexpr int kSteps = 48;  // a peak between each pair of bypass steps
  std::array<Operating, kSteps + 1> grid;
  for (int i = 0; i <= kSteps; ++i) {
    const double current = 1.01 * largest_ * i / kSteps;
    grid[i] = {current, AtCurrent(current).voltage};
  }
  Operating best;
  for (int i = 1; i < kSteps; ++i) {
    if (grid[i].power() < grid[i - 1].power() || grid[i].power() < grid[i + 1].power()) continue;
    const Operating peak = Peak(grid[i - 1].current, grid[i + 1].current);
    if (peak.power() > best.power()) best = peak;
    if (grid[i].power() > best.power()) best = grid[i];
  }
  return best;
}

}  // namespace years
