#pragma once

#include <array>
#include <vector>

#include "faults/field_module.h"
#include "faults/random.h"

namespace years {

constexpr int kGroups = 3;
constexpr int kClasses = 12;  // classes of equal cells, four a group
constexpr int kCellsOfClass = 5;
constexpr int kCells = kClasses * kCellsOfClass;
constexpr double kKelvin = 273.15;

// A silicon module as built: 60 cells in three groups, each with a bypass diode. Five cells of a
// class are equal; classes differ.
struct Design {
  std::array<faults::field::Cell, kClasses> cells;  // at 1000 W/m2 and 25 C
  std::array<double, kClasses> warmer;              // K at 1000 W/m2, above the mean of the module
  std::array<double, kClasses> stress;              // of potential-induced damage, relative, mean 0
  std::array<faults::field::BypassDiode, kGroups> diodes;  // at 25 C
  double series_per_kelvin = 0;                            // relative, of the series resistance
};
Design DrawDesign(faults::Random* random);

// Series resistance (ohm), shunt conductance (S) and recombination current (A) of the module at
// 25 C: sums over the cells, of the conductance the inverse of the summed resistance.
double SeriesOhm(const Design& design);
double ShuntOhm(const Design& design);
double Recombination_A(const Design& design);  // mean of the cells

// What differs from the module as built.
struct State {
  double light = 1;                      // transmission to the brightest cell
  double series = 1;                     // factor on the series resistance
  double series_ohm = 0;                 // of the module, in addition
  double recombination = 1;              // factor on the recombination current
  double shunt = 1;                      // factor on the shunt conductance
  bool uneven = false;                   // damage follows the stress of the class
  bool covered = false;                  // `cover` applies
  std::array<double, kClasses> cover{};  // light of each class relative to the brightest
  int shorted = -1;                      // group with a shorted bypass diode
};

struct Operating {
  double current = 0;
  double voltage = 0;
  double power() const { return current * voltage; }
};

// A module in a state, at a light (1: 1000 W/m2) and temperature of its cells.
class LitModule {
 public:
  LitModule(const Design& design, const State& state, double suns, double kelvin);

  // Voltage at a current with the light multiplied by `light`.
  faults::field::Point AtCurrent(double current, double light = 1);
  // Point at a voltage; `guess` is a current nearby. A.
  faults::field::Point AtVoltage(double voltage, double light, double guess);
  double OpenCircuit() { return AtCurrent(0).voltage; }
  double ShortCircuit() { return AtVoltage(0, 1, largest_).current; }
  Operating MaximumPower();
  double LargestPhotocurrent() const { return largest_; }

 private:
  faults::field::Point AtCurrentOfGroup(int group, double current, double light);
  faults::field::Point AtCurrentOfChain(int group, double current, double light);
  Operating Peak(double low, double high);

  std::array<faults::field::Cell, kClasses> cells_;
  std::array<double, kClasses> junction_V_;  // of the last call, from which the next one starts
  std::array<faults::field::BypassDiode, kGroups> diodes_;
  int shorted_;
  bool covered_;
  double largest_ = 0;   // A, photocurrent of the brightest cell
  double smallest_ = 0;  // and of the dimmest outside a shorted group
};

}  // namespace years
