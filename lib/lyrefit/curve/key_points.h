#pragma once

#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// The five key points of a data sheet, and the fill factor. NaN if the curve does not determine a
// value.
struct KeyPoints {
  double short_circuit_current_A = kUnknown;  // Isc
  double open_circuit_voltage_V = kUnknown;   // Voc
  double max_power_voltage_V = kUnknown;      // Vmp
  double max_power_current_A = kUnknown;      // Imp
  double max_power_W = kUnknown;              // Pmp
  double fill_factor = kUnknown;              // Pmp / (Isc Voc)
};

// Key points of measured points in any order, in V, A and W. Isc and Voc are interpolated linearly
// between the two points next to the axis. If the curve ends before an axis by at most 5 % of its
// own range, they are extrapolated, otherwise NaN. The extrapolation uses the last point and the
// nearest one at least 1 % of the voltage range away. The maximum power is the vertex of a parabola
// in V through the best point and its two neighbours. The best point itself is used at the end of a
// curve, and if uneven spacing makes the parabola unreliable.
KeyPoints FindKeyPoints(const std::vector<double>& voltage_V, const std::vector<double>& current_A);

// Fill factor that Green's approximation gives an ideal diode: (v - ln(v + 0.72)) / (v + 1) with
// v = Voc / (n Ns k T / q) (doi:10.1016/0038-1101(81)90062-9). Voltages in V.
double GreenFillFactor(double voc_V, double nNsVth);

// Index of the hysteresis of a sweep forward and one in reverse, by their powers,
// (Pmp_rev - Pmp_fwd) / Pmp_rev: doi:10.1021/acsenergylett.8b01627.
inline double HysteresisIndex(const KeyPoints& forward, const KeyPoints& reverse) {
  return (reverse.max_power_W - forward.max_power_W) / reverse.max_power_W;
}

}  // namespace lyrefit
