#pragma once

#include <cstddef>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// A column of numbers, one per device. `stride` 0: the same number for all devices.
struct DeviceColumn {
  const double* data = nullptr;  // of the first device
  std::ptrdiff_t stride = 1;     // in numbers

  // Value of device `i`, from 0.
  double operator[](std::size_t i) const { return data[static_cast<std::ptrdiff_t>(i) * stride]; }
};

// Single-diode devices, each with its own parameters (names as in pvlib):
//
//   I = Iph - Is (exp(Vd / nNsVth) - 1) - Vd / Rsh - Iph d2mutau / (NsVbi - Vd),  Vd = V + I Rs
//
// The last term (see term.h) applies if d2mutau is given. Ranges: Iph finite, Is > 0, Rs >= 0, Rsh
// > 0 or infinite, nNsVth > 0, d2mutau >= 0, NsVbi > 0. All results of a device outside these
// ranges, or with a NaN, are NaN. Other devices are not affected.
struct SingleDiodes {
  std::size_t size = 0;                // number of devices
  DeviceColumn photocurrent;           // A
  DeviceColumn saturation_current;     // A
  DeviceColumn resistance_series;      // ohm
  DeviceColumn resistance_shunt;       // ohm
  DeviceColumn nNsVth;                 // n Ns k T / q, V
  DeviceColumn recombination = {};     // d2mutau, V; no data: no such term
  DeviceColumn built_in_voltage = {};  // NsVbi, V
};

// CurrentsAt: I(V) in ampere of every device at its own voltage. VoltagesAt: V(I) in volt at its
// own current. The error is about 1e-15 of the largest of I, Iph and Is (of V and nNsVth). V(I) is
// NaN if no voltage gives that current: beyond Iph + Is without a shunt.
void CurrentsAt(const SingleDiodes& devices, const DeviceColumn& voltage_V, double* current_A);
void VoltagesAt(const SingleDiodes& devices, const DeviceColumn& current_A, double* voltage_V);

// The key points of pvlib's singlediode. Every pointer refers to `size` numbers.
struct SingleDiodePoints {
  double* i_sc;  // A, at 0 V
  double* v_oc;  // V, at 0 A
  double* i_mp;  // A, at maximum power
  double* v_mp;  // V, at maximum power
  double* p_mp;  // W
  double* i_x;   // A, at v_oc / 2
  double* i_xx;  // A, at (v_oc + v_mp) / 2
};
// The maximum power point is the root of dP/dV, so v_mp is as accurate as the other points. (A
// search along P itself gives half the digits.) All points are 0 at Iph = 0 and NaN where
// undefined, at Iph < 0.
void KeyPointsOf(const SingleDiodes& devices, const SingleDiodePoints& points);

}  // namespace lyrefit
