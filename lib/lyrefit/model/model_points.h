#pragma once

#include <cmath>

#include "lyrefit/curve/key_points.h"
#include "lyrefit/model/device.h"

namespace lyrefit {

// Isc, Voc and the maximum power point of a device's model curve, with a relative error of about
// 1e-12. With effects they are read from a fine sweep, with an error of about 1e-6. Voc and all
// that depends on it is NaN if the device gives no power (a dark curve).
KeyPoints ModelKeyPoints(const Device& device, const double* p);

// Voc alone, in V, at lower cost.
double ModelOpenCircuit(const Device& device, const double* p);

// One diode alone, in closed form: the voltage in V at which it carries a current, and the saturation
// current in A of one that carries a current at a voltage. `nNsVth`: n Ns k T / q in V.
inline double DiodeVoltage(double current_A, double saturation_current_A, double nNsVth) {
  return nNsVth * std::log1p(current_A / saturation_current_A);
}
inline double SaturationCurrent(double current_A, double voltage_V, double nNsVth) {
  return current_A / std::expm1(voltage_V / nNsVth);
}

}  // namespace lyrefit
