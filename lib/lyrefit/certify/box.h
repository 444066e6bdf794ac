#pragma once

#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/certify/certify_options.h"
#include "lyrefit/certify/interval.h"
#include "lyrefit/certify/mixture.h"
#include "lyrefit/certify/upper_bound.h"
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

// These functions convert the requested ranges of parameters to those of a proof.

// Errors: a range that is empty or reversed, and ranges for fewer diodes than the largest model
// has.
Expected<void> CheckRanges(const CertifyOptions& options);

// The options with `diodes` filled: an empty list becomes three diodes with the common ranges.
// Otherwise the common range of n is widened to include the n of every diode.
CertifyOptions WithEveryDiode(CertifyOptions options);

// AnyDiode() is the window of u for every n of the options and any Is. BoxOf() has the windows of u
// and Is of the first `diodes` diodes. `thermal_voltage_V` is Ns k T / q, and `safe_V` an interval
// that contains it. If options.rigorous is set, the windows are rounded outwards, so that they
// contain all n in spite of rounding.
Window AnyDiode(const CertifyOptions& options, double thermal_voltage_V,
                const WideInterval& safe_V);
std::vector<Window> BoxOf(const CertifyOptions& options, int diodes, double thermal_voltage_V,
                          const WideInterval& safe_V);

// Sets the ranges of photocurrent (A) and shunt conductance (S) in data made by CurveData().
void SetRanges(const CertifyOptions& options, MixtureData* data);

// The ranges for fits of a model of `diodes` diodes. `rs_upper_ohm` is the largest Rs that the
// proof searches.
ModelRanges RangesOfModel(const CertifyOptions& options, int diodes, double rs_upper_ohm,
                          double reference_voltage_V);

}  // namespace lyrefit
