#pragma once

#include <vector>

#include "lyrefit/certify/interval.h"
#include "lyrefit/certify/mixture.h"
#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// Inputs and results of a rigorous proof, in intervals. The readings, the temperature in kelvin,
// the ranges and the parameters are taken as exact doubles. k / q is the exact quotient of the
// decimal numbers that constants.h names.

// Ns k T / q, in volt.
WideInterval SafeThermalVoltage(const Conditions& conditions, ConstantSet constants);

// The window of u = 1 / (n Ns k T / q), in 1/V, that contains every n of a range.
Window SafeWindow(double n_lower, double n_upper, const WideInterval& thermal_voltage_V);

// Lower bound of the RMSE of `points` points, from a lower bound of half the sum of squares.
double SafeRmse(double half_sum_of_squares, std::size_t points);

// Upper bound of (rmse - lower) / rmse; 0 where rmse is 0.
double SafeGap(double rmse, double lower);

struct SafeDiode {
  double n = 1;  // per cell
  double saturation_current_A = 0;
};

// An upper bound of the measured-current RMSE (unweighted) of one model on a curve.
double SafeUpperRmse(const IvCurve& curve, const WideInterval& thermal_voltage_V,
                     double photocurrent_A, double resistance_series_ohm,
                     const WideInterval& conductance_shunt_S, const std::vector<SafeDiode>& diodes);

}  // namespace lyrefit
