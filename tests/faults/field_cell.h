#pragma once

namespace faults::field {

// Current of a cell under reverse bias, when its neighbours drive more current than its light
// delivers.
enum class Reverse { kShuntBreakdown, kSoftPower, kMultiplication };

// One cell at its own temperature and light in the module. A, V, S, ohm, K.
struct Cell {
  double photocurrent = 8;
  double diffusion_A = 1e-10;
  double diffusion_ideality = 1;
  double recombination_A = 0;
  double recombination_ideality = 2;
  double shunt_S = 1e-3;
  double series_ohm = 4e-3;
  double kelvin = 298.15;
  Reverse reverse = Reverse::kShuntBreakdown;
  double reverse_V = 15;  // magnitude of the breakdown voltage; for kSoftPower the voltage at which
                          // it carries `reverse_A`
  double reverse_exponent = 3.4;
  double reverse_A = 8;         // nominal photocurrent
  double reverse_factor = 0.1;  // kShuntBreakdown only: fraction of the shunt that breaks down
};

struct Law {
  double current;  // generated current at the junction, before the series resistance
  double slope;    // derivative by the junction voltage, negative
};
Law AtJunctionVoltage(const Cell& cell, double junction_V);

struct Point {
  double current;
  double voltage;
  double slope;  // dV/dI, negative
};
// Terminal voltage at which the cell delivers `current`, with its slope.
Point AtCurrent(const Cell& cell, double current);

}  // namespace faults::field
