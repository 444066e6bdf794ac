#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// Number of equal bins of V / Voc, from 0 to 1, in which shapes are compared.
constexpr int kShapeBins = 16;

// Quantities of a sweep for comparison with other sweeps, from a single-diode fit with equal
// weights. Equal weights give the best repeatability; weights by noise would vary from day to day.
struct SweepState {
  std::string name;
  int cells = 1;
  Setup setup = Setup::kUnknown;
  double irradiance_W_m2 = 0;  // NaN if not stated
  double temperature_C = 0;    // NaN if not stated
  double isc_A = 0;            // isc, voc, fill factor and maximum power are of the model
  double voc_V = 0;
  double fill_factor = 0;
  double max_power_W = 0;
  double photocurrent_A = 0;
  double ideality = 0;
  double series_ohm = 0;
  double shunt_S = 0;
  // V / Voc of each reading (ascending), and measured minus model current in fractions of Isc.
  // `shape`: means of the latter in kShapeBins bins (NaN in empty bins).
  std::vector<double> place, off;
  Eigen::VectorXd shape;
};

// A fitted sweep, with all that a fit of changed readings needs.
struct FittedSweep {
  WeightedData weighted;
  LawFit fit;
  SweepState state;
};

// Fits a single diode to one sweep. Errors: readings that a diagnosis rejects, a dark curve, no
// usable fit, no Voc or maximum power.
Expected<FittedSweep> FitSweep(const IvCurve& curve);

// State of the sweep after `change` (one value per reading, in current scales) is added to the
// currents. If the new fit fails, the old state.
SweepState StateWith(const FittedSweep& sweep, const std::vector<double>& change);

}  // namespace lyrefit
