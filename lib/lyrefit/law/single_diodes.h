#pragma once

#include <cstddef>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Numbers of many devices; `stride` 0 is one number for all of them.
struct DeviceColumn {
  const double* data = nullptr;  // of the first device
  std::ptrdiff_t stride = 1;     // in numbers

  // Of device `i`, from 0.
  double operator[](std::size_t i) const { return data[static_cast<std::ptrdiff_t>(i) * stride]; }
};

// Many single-diode devices, each with parameters of its own (names as in pvlib):
//
//   I = Iph - Is (exp(Vd / nNsVth) - 1) - Vd / Rsh - Iph d2mutau / (NsVbi - Vd),  Vd = V + I Rs
//
// the last term (see term.h) where there is a d2mutau. Ranges: Iph finite, Is > 0, Rs >= 0, Rsh > 0
// or infinite, nNsVth > 0, d2mutau >= 0, NsVbi > 0. Of a device outside of them, or with a NaN, every
// answer is NaN, and the others are not touched by it.
struct SingleDiodes {
  std::size_t size = 0;                // how many devices
  DeviceColumn photocurrent;           // A
  DeviceColumn saturation_current;     // A
  DeviceColumn resistance_series;      // ohm
  DeviceColumn resistance_shunt;       // ohm
  DeviceColumn nNsVth;                 // n Ns k T / q, V
  DeviceColumn recombination = {};     // d2mutau, V; no data: none
  DeviceColumn built_in_voltage = {};  // NsVbi, V
};

// I(V) in ampere of every device at its own voltage, and V(I) in volt at its own current. Error
// about 1e-15 of the largest of I, Iph and Is (of V and nNsVth). V(I) is NaN where no voltage gives
// that current: beyond Iph + Is without a shunt.
void CurrentsAt(const SingleDiodes& devices, const DeviceColumn& voltage_V, double* current_A);
void VoltagesAt(const SingleDiodes& devices, const DeviceColumn& current_A, double* voltage_V);

// Where a curve is usually looked at. Every pointer has room for `size` numbers.
struct SingleDiodePoints {
  double* i_sc;  // A, at no voltage
  double* v_oc;  // V, at no current
  double* i_mp;  // A, at maximum power
  double* v_mp;  // V, at maximum power
  double* p_mp;  // W
  double* i_x;   // A, at v_oc / 2
  double* i_xx;  // A, at (v_oc + v_mp) / 2
};
// The maximum power point is the root of dP/dV, so that v_mp is as accurate as the others (a search
// along P itself gives half the digits). Under no light all points are 0; below, where Iph < 0, there
// is no such point: NaN.
void KeyPointsOf(const SingleDiodes& devices, const SingleDiodePoints& points);

}  // namespace lyrefit
