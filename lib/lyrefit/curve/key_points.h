#pragma once

#include <vector>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// The five numbers a data sheet prints, and the fill factor. NaN where the curve does not reach.
struct KeyPoints {
  double short_circuit_current_A;  // Isc
  double open_circuit_voltage_V;   // Voc
  double max_power_voltage_V;      // Vmp
  double max_power_current_A;      // Imp
  double max_power_W;              // Pmp
  double fill_factor;              // Pmp / (Isc Voc)
};

// Key points of measured points in any order. Isc and Voc by linear interpolation between the two
// neighbours of the axis; where the curve stops short of an axis by at most 5 % of its own range
// they are extrapolated on the last point and the nearest one at least 1 % of the voltage range
// away, else NaN. Maximum power from the parabola through the best point and its neighbours in V
// (the best point itself at the end of a curve, and where very uneven neighbours make the parabola
// worthless).
KeyPoints FindKeyPoints(const std::vector<double>& voltage_V, const std::vector<double>& current_A);

}  // namespace lyrefit
