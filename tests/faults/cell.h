#pragma once

#include "faults/device.h"
#include "faults/effects.h"

namespace faults {

// A cell at given irradiance and temperature. A, V, S, ohm.
struct Cell {
  double photocurrent = 1;
  double saturation = 1e-9;
  double n_vt = 0.03;
  double saturation_2 = 0;
  double two_vt = 0.05;
  double thermal_voltage = 0.0257;
  double conductance = 0;
  double resistance = 0;
  double shunt_strength = 0;
  double shunt_exponent = 2;
  double breakdown = 0;
  double breakdown_voltage = -20;
  double collection = 0;
  double lumped_drop = 0;
  double inverse_contact = 0;
  double far_ohm = 0;
  double far_share = 0.5;
  // Charge: the junction's own current over the last `interval_s`, which began with `charge`.
  double capacitance = 0;
  double diffusion_s = 0;
  double charge = 0;
  double interval_s = 0;  // 0: no charging
};

// A cell of the device where `suns` and `kelvin` really hold.
Cell CellUnder(const Device& device, const Effects& effects, double suns, double kelvin);

double JunctionCurrent(const Cell& cell, double junction_voltage);
double JunctionCharge(const Cell& cell, double junction_voltage);

// Both follow from the junction's voltage (with a far part: of that part) without any
// equation to solve; current falls with it, voltage rises.
struct Terminal {
  double voltage;
  double current;
};
Terminal AtJunction(const Cell& cell, double junction_voltage);

// Junction voltage that belongs to a terminal voltage or a current.
double JunctionAtVoltage(const Cell& cell, double voltage);
double JunctionAtCurrent(const Cell& cell, double current);

inline double CellCurrent(const Cell& cell, double voltage) {
  return AtJunction(cell, JunctionAtVoltage(cell, voltage)).current;
}
inline double CellVoltage(const Cell& cell, double current) {
  return AtJunction(cell, JunctionAtCurrent(cell, current)).voltage;
}

}  // namespace faults
