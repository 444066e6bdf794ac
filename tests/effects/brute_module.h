#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "effects/synthetic_readings.h"
#include "lyrefit/base/constants.h"
#include "lyrefit/model/effect.h"

namespace lyrefit {

// A module solved cell by cell with nested bisections: a slow reference for effects on cell groups.
// Units of Reading. It has no code of the solver.
struct BruteCells {
  double count = 1;
  double light = 1;
  double leak = 0;
};

// Cells in series that share a bypass diode; two such chains in parallel in half-cut modules.
struct BruteSubstring {
  std::vector<std::vector<BruteCells>> chains;
  bool bypassed = true;
};

class BruteModule {
 public:
  BruteModule(const Readings& readings, std::vector<BruteSubstring> substrings)
      : substrings_(std::move(substrings)) {
    thermal_ = ThermalVoltage(readings.reference_temperature_K);
    saturation_ = std::exp(cell_.log_pivot) /
                  std::expm1(readings.pivot_voltage / (cell_.ideality * thermal_));
  }

  double bypass_voltage = 0.5;  // at one current scale
  double bypass_ideality = 1.2;
  double soft_voltage = 0;  // of the soft reverse law; 0: the shunt only
  double soft_exponent = 3.4;

  // Current at the voltage of the whole module.
  double Current(double voltage) const {
    return FallingRoot([&](double current) { return Voltage(current) - voltage; }, -40, 3);
  }

 private:
  // Ridders' method, which follows exponentials well.
  template <class F>
  static double FallingRoot(const F& f, double low, double high) {
    double above = f(low), below = f(high);
    for (int k = 0; k < 80 && high - low > 1e-13 * (1 + std::fabs(low)); ++k) {
      const double middle = 0.5 * (low + high), value = f(middle);
      const double x = middle + (middle - low) * value / std::sqrt(value * value - above * below);
      const double there = f(x);
      if (value == 0 || there == 0) return value == 0 ? middle : x;
      for (const auto& [at, found] : {std::pair(middle, value), std::pair(x, there)}) {
        if (found > 0 && at > low) low = at, above = found;
        if (found < 0 && at < high) high = at, below = found;
      }
    }
    return 0.5 * (low + high);
  }

  double CellCurrent(const BruteCells& cell, double u) const {
    double current = cell_.photocurrent * cell.light - (cell_.conductance + cell.leak) * u -
                     saturation_ * std::expm1(u / (cell_.ideality * thermal_));
    if (u < 0 && soft_voltage > 0) {
      current += cell_.photocurrent * std::pow(-u / soft_voltage, soft_exponent);
    }
    return current;
  }

  // Sum of the junction voltages of a chain at its current.
  double ChainVoltage(const std::vector<BruteCells>& chain, double current) const {
    double sum = 0;
    for (const BruteCells& cell : chain) {
      sum += cell.count *
             FallingRoot([&](double u) { return CellCurrent(cell, u) - current; }, -400, 1.2);
    }
    return sum;
  }

  static double CountOf(const std::vector<BruteCells>& chain) {
    double count = 0;
    for (const BruteCells& cell : chain) count += cell.count;
    return count;
  }

  double BypassCurrent(double reverse) const {
    const double scale = bypass_ideality * thermal_;
    return std::exp((reverse - bypass_voltage) / scale) - std::exp(-bypass_voltage / scale);
  }

  // The series resistance of a single chain carries the current of the module, that of two chains
  // the current of each.
  double SubstringVoltage(const BruteSubstring& substring, double current) const {
    const auto& first = substring.chains.front();
    const double cells = CountOf(first);
    const double ohm = cells * cell_.resistance;
    if (substring.chains.size() == 1) {
      if (!substring.bypassed) return ChainVoltage(first, current) - ohm * current;
      const double own = FallingRoot(
          [&](double carried) {
            const double voltage = ChainVoltage(first, carried) - ohm * current;
            return current - carried - BypassCurrent(-voltage);
          },
          -40, 3);
      return ChainVoltage(first, own) - ohm * current;
    }
    return FallingRoot(
        [&](double voltage) {
          double carried = substring.bypassed ? BypassCurrent(-voltage) : 0;
          for (const auto& chain : substring.chains) {
            carried += 0.5 * FallingRoot(
                                 [&](double own) {
                                   return ChainVoltage(chain, own) - ohm * own - voltage;
                                 },
                                 -40, 3);
          }
          return carried - current;
        },
        substring.bypassed ? -2 : -20, 1.2 * cells);
  }

  double Voltage(double current) const {
    double sum = 0;
    for (const BruteSubstring& substring : substrings_) sum += SubstringVoltage(substring, current);
    return sum;
  }

  CellValues cell_;
  double thermal_ = 0.0257;
  double saturation_ = 1e-10;
  std::vector<BruteSubstring> substrings_;
};

// Compares the currents of a law with this effect with those of the module, at every `stride`-th
// voltage from 0 to beyond open circuit.
inline void ExpectBruteCurrents(const char* id, const std::vector<double>& p, int cells,
                                const std::vector<BruteSubstring>& substrings,
                                void (*set)(BruteModule*) = nullptr, int stride = 3,
                                double tolerance = 1e-7) {
  Readings readings = SyntheticReadings(DataKind::kForward, cells);
  std::vector<Reading> some;
  for (std::size_t k = 1; k < readings.points.size(); k += stride)
    some.push_back(readings.points[k]);
  readings.points = some;
  BruteModule module(readings, substrings);
  if (set != nullptr) set(&module);
  const Settled at = WithEffect(*FindEffect(id), p, readings);
  const std::vector<double> current = Currents(at.law, readings, at.p);
  ASSERT_EQ(current.size(), some.size());
  for (std::size_t k = 0; k < some.size(); ++k) {
    EXPECT_NEAR(current[k], module.Current(some[k].voltage * cells), tolerance)
        << "at " << some[k].voltage << " V per cell";
  }
}

}  // namespace lyrefit
