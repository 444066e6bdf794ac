#include "faults/field_cell.h"

#include <algorithm>
#include <cmath>

namespace faults::field {
namespace {

constexpr double kVoltPerKelvin = 1.380649e-23 / 1.602176634e-19;

void AddDiode(double saturation, double scale, double v, Law* law) {
  if (saturation == 0) return;
  const double e = saturation * std::exp(v / scale);
  law->current -= e - saturation;
  law->slope -= e / scale;
}

// Shunt current with a multiplied part that diverges at the breakdown voltage.
void AddBrokenShunt(const Cell& cell, double v, Law* law) {
  const double near = 1 + v / cell.reverse_V;
  const double extra = cell.reverse_factor * std::pow(near, -cell.reverse_exponent);
  law->current -= cell.shunt_S * v * extra;
  law->slope -= cell.shunt_S * extra * (1 - cell.reverse_exponent * v / (cell.reverse_V * near));
}

void AddSoftPower(const Cell& cell, double v, Law* law) {
  const double part = -v / cell.reverse_V;
  const double current = cell.reverse_A * std::pow(part, cell.reverse_exponent);
  law->current += current;
  law->slope += current * cell.reverse_exponent / v;
}

// Avalanche multiplication of the photocurrent and of a small leakage current.
void AddMultiplication(const Cell& cell, double v, Law* law) {
  const double part = std::pow(-v / cell.reverse_V, cell.reverse_exponent);
  const double carried = cell.photocurrent + 0.02 * cell.reverse_A;
  law->current += carried * part / (1 - part);
  law->slope += carried * cell.reverse_exponent * part / (v * (1 - part) * (1 - part));
}

struct Bracket {
  double low;
  double high;
};

Bracket Around(const Cell& cell, double current) {
  const double thermal = kVoltPerKelvin * cell.kelvin;
  const double lack = cell.photocurrent - current;
  if (lack <= 0) {  // with reverse breakdown the junction conducts more than the shunt alone
    double low = lack / cell.shunt_S - 1e-12;
    if (cell.reverse != Reverse::kSoftPower) {
      low = std::max(low, -cell.reverse_V * (1 - 1e-13));
    }
    return {low, 0};
  }
  double high = lack / cell.shunt_S;
  const double diffusion = cell.diffusion_ideality * thermal;
  high = std::min(high, diffusion * std::log1p(lack / cell.diffusion_A));
  if (cell.recombination_A > 0) {
    const double recombination = cell.recombination_ideality * thermal;
    high = std::min(high, recombination * std::log1p(lack / cell.recombination_A));
  }
  return {0, high + 1e-12};
}

}  // namespace

Law AtJunctionVoltage(const Cell& cell, double v) {
  const double thermal = kVoltPerKelvin * cell.kelvin;
  Law law{cell.photocurrent - cell.shunt_S * v, -cell.shunt_S};
  AddDiode(cell.diffusion_A, cell.diffusion_ideality * thermal, v, &law);
  AddDiode(cell.recombination_A, cell.recombination_ideality * thermal, v, &law);
  if (v >= 0) return law;
  if (cell.reverse == Reverse::kShuntBreakdown) AddBrokenShunt(cell, v, &law);
  if (cell.reverse == Reverse::kSoftPower) AddSoftPower(cell, v, &law);
  if (cell.reverse == Reverse::kMultiplication) AddMultiplication(cell, v, &law);
  return law;
}

// Newton steps from the side from which they converge monotonically. Every evaluation shrinks the
// bracket; a step that leaves the bracket is replaced by a bisection.
Point AtCurrent(const Cell& cell, double current) {
  Bracket in = Around(cell, current);
  double v = current < cell.photocurrent ? in.high : 0.5 * (in.low + in.high);
  Law law{};
  for (int i = 0; i < 200; ++i) {
    law = AtJunctionVoltage(cell, v);
    const double off = law.current - current;
    if (std::fabs(off) < 1e-14 * cell.reverse_A) break;
    (off > 0 ? in.low : in.high) = v;
    double next = v - off / law.slope;
    if (!(next > in.low && next < in.high)) next = 0.5 * (in.low + in.high);
    const double step = std::fabs(next - v);
    v = next;
    if (step < 1e-14 * (1 + std::fabs(v))) break;
  }
  return {current, v - current * cell.series_ohm, 1 / law.slope - cell.series_ohm};
}

}  // namespace faults::field
