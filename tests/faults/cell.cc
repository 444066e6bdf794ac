#include "faults/cell.h"

#include <algorithm>
#include <cmath>

#include "faults/root.h"

namespace faults {
namespace {

constexpr double kBuiltIn = 0.9;  // built-in voltage of a junction, V
constexpr double kFar = 1e6;      // V, returned where a blocking contact cannot carry the current

double Diode(double saturation, double exponent) {
  return saturation == 0 ? 0 : saturation * std::expm1(std::min(exponent, 300.0));
}

double Shunt(const Device& device, const Effects& effects, double suns) {
  if (effects.photoshunt == 0) return device.conductance;
  if (!effects.photoshunt_exponential) return device.conductance + effects.photoshunt * suns;
  const double lit = 1 / (device.conductance + effects.photoshunt);
  const double dark = 1 / device.conductance;
  return 1 / (lit + (dark - lit) * std::exp(-5.5 * suns));
}

}  // namespace

Cell CellUnder(const Device& device, const Effects& effects, double suns, double kelvin) {
  Cell cell;
  const double ratio = kelvin / kReferenceK;
  const double arrhenius = (device.bandgap_eV + effects.bandgap_eV) / kBoltzmannOverCharge *
                           (1 / kReferenceK - 1 / kelvin);
  const double alpha = device.isc_tempco_per_K + effects.isc_tempco_per_K;
  cell.photocurrent = device.photocurrent * suns * (1 + alpha * (kelvin - kReferenceK));
  cell.thermal_voltage = kBoltzmannOverCharge * kelvin;
  cell.saturation = device.saturation * ratio * ratio * ratio * std::exp(arrhenius);
  cell.n_vt = device.ideality * cell.thermal_voltage;
  cell.saturation_2 = device.saturation_2 * std::pow(ratio, 2.5) * std::exp(arrhenius / 2);
  cell.two_vt = 2 * cell.thermal_voltage;
  cell.conductance = Shunt(device, effects, suns);
  cell.resistance = device.resistance + effects.lead_ohm;
  cell.shunt_strength = effects.shunt_strength;
  cell.shunt_exponent = effects.shunt_exponent;
  cell.breakdown = effects.breakdown;
  cell.breakdown_voltage = effects.breakdown_voltage;
  cell.collection = effects.collection;
  cell.lumped_drop = effects.lumped_drop;
  cell.inverse_contact = effects.inverse_contact;
  cell.far_ohm = effects.far_ohm;
  cell.far_share = effects.far_share;
  cell.capacitance = effects.capacitance;
  cell.diffusion_s = effects.diffusion_s;
  return cell;
}

double JunctionCharge(const Cell& cell, double v) {
  return cell.capacitance * v + cell.diffusion_s * Diode(cell.saturation, v / cell.n_vt);
}

double JunctionCurrent(const Cell& cell, double v) {
  double current = cell.photocurrent - cell.conductance * v;
  current -= Diode(cell.saturation, v / cell.n_vt);
  current -= Diode(cell.saturation_2, v / cell.two_vt);
  if (cell.shunt_strength != 0) {
    current -= std::copysign(cell.shunt_strength * std::pow(std::fabs(v), cell.shunt_exponent), v);
  }
  if (cell.breakdown != 0) {
    current -= cell.breakdown * v * std::pow(std::max(1 - v / cell.breakdown_voltage, 0.01), -3.4);
  }
  if (cell.collection != 0) {
    current -= cell.photocurrent * cell.collection / std::max(kBuiltIn - v, 0.01);
  }
  if (cell.interval_s > 0) current -= (JunctionCharge(cell, v) - cell.charge) / cell.interval_s;
  return current;
}

Terminal AtJunction(const Cell& cell, double v) {
  double current = JunctionCurrent(cell, v);
  if (cell.far_ohm > 0) {
    v -= current * cell.far_ohm;
    current = cell.far_share * current + (1 - cell.far_share) * JunctionCurrent(cell, v);
  }
  double voltage = v - current * (cell.resistance + cell.lumped_drop * std::fabs(current));
  if (cell.inverse_contact != 0) {
    const double through = current * cell.inverse_contact;
    voltage = through > -1 ? voltage - cell.thermal_voltage * std::log1p(through) : kFar;
  }
  return {voltage, current};
}

double JunctionAtVoltage(const Cell& cell, double voltage) {
  return Root([&](double v) { return AtJunction(cell, v).voltage - voltage; }, voltage, 0.02);
}

double JunctionAtCurrent(const Cell& cell, double current) {
  const double guess = current > cell.photocurrent ? -0.1 : 0.5;
  return Root([&](double v) { return current - AtJunction(cell, v).current; }, guess, 0.05);
}

}  // namespace faults
