#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// Where along a curve its shape is looked at: parts of V / Voc from 0 to 1.
constexpr int kShapeBins = 16;

// What of a sweep is compared from sweep to sweep: a single diode, every reading trusted alike. So
// fitted it repeats best; weights that follow the noise follow the day.
struct SweepState {
  std::string name;
  int cells = 1;
  double irradiance_W_m2 = 0;  // NaN where nobody stated it
  double temperature_C = 0;    // the same
  double isc_A = 0;            // of the model, as the next three
  double voc_V = 0;
  double fill_factor = 0;
  double max_power_W = 0;
  double photocurrent_A = 0;
  double ideality = 0;
  double series_ohm = 0;
  double shunt_S = 0;
  // Measured less model in parts of Isc over V / Voc, which rises, and its means in the bins (NaN
  // where there are no readings).
  std::vector<double> place, off;
  Eigen::VectorXd shape;
};

// The sweep laid out and fitted, to be fitted again with something done to it.
struct FittedSweep {
  WeightedData weighted;
  LawFit fit;
  SweepState state;
};

// Errors: readings that no diagnosis takes, a dark curve, several sweeps under different
// conditions, no fit.
Expected<FittedSweep> FitSweep(const IvCurve& curve);

// The state after `change` (in current scales, of every reading) is added to the readings.
SweepState StateWith(const FittedSweep& sweep, const std::vector<double>& change);

}  // namespace lyrefit
