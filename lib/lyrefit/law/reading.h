#pragma once

#include <optional>
#include <vector>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// One point of a measurement, in the units in which effects are written: voltages per cell in
// volt, currents in parts of the measurement's current scale (about Isc), conductances in scale
// per volt of a cell.
struct Reading {
  double voltage = 0;        // per cell, V
  double current = 0;        // in current scales
  double irradiance = 1;     // as the sensor said, in suns (1000 W/m2)
  double temperature_K = 0;  // of the cell, as the sensor said
  double x = 0;              // time within the measurement, scaled to -1/2 .. 1/2
  double rate = 0;           // dV/dt in parts of the measurement's rate scale, signed
  int curve = 0;             // position in the set
  int index = 0;             // position in its curve
  bool dark = false;         // so is its curve
  int segment = 0;           // monotone stretches of voltage, counted through the whole set
  // Of a mean of neighbouring readings: how many, and the mean square of their distances from it
  // (in current scales, the curve's own slope taken out).
  double weight = 1;
  double scatter = 0;
};

// What the numbers of a measurement are scaled by.
struct ReadingScale {
  double current_A = 1;
  int cells = 1;                 // in series
  int strings = 1;               // in parallel
  double rate_V_per_s = 1;       // per cell; per reading where no times were recorded
  double span_s = 0;             // duration; 0 where no times were recorded
  bool times = false;            // times were recorded
  double saturation_2_unit = 1;  // see Cell
  double reach_V = 1;            // largest |voltage| per cell
};

// What kind of measurement it is: decides which effects it can show.
struct DataTraits {
  int curves = 1;              // with conditions of their own
  bool single = true;          // one condition only (whatever the number of sweeps)
  bool reverse = false;        // points well below 0 V
  bool beyond_voc = false;     // points of negative current at light
  bool up_down = false;        // both directions under the same conditions
  bool dark = false;           // a dark curve beside a lit one
  bool only_dark = false;      // nothing but dark curves
  int irradiance_levels = 1;   // of lit curves
  int temperature_levels = 1;  // of all curves
  bool module = false;         // more than one cell in series
  int substrings = 0;          // bypass groups; 0: none, or not known
  bool bypass_known = false;   // stated by somebody
  int cells = 1;               // as reckoned with
  int stated_cells = 1;        // as stated, or assumed by a reader
  bool cells_known = true;     // stated by somebody
  bool bandgap_known = true;   // the same
  bool tempco_known = true;    // of Isc
  double lowest_voltage = 0;   // per cell
  double highest_voltage = 0;  // per cell
  double open_circuit = 0;     // per cell, estimate of Voc; 0 where there is none
  double thermal_voltage = 0;  // k T / q at the reference
  int readings = 0;
  std::vector<double> step_times;  // x between two readings: where an irradiance step may lie
  // Between two readings of a sweep, in current scales: where a range of the current may end.
  std::vector<double> range_currents;
};

// Bypass groups to reckon with: as stated, else as modules of so many cells have them.
int SubstringsOf(const DataTraits& traits);

// All points of a measurement, and what is known of it as a whole.
struct Readings {
  std::vector<Reading> points;
  ReadingScale scale;
  DataTraits traits;
  double reference_temperature_K = 298.15;  // where parameters are quoted
  double bandgap_eV = 1.121;
  std::optional<double> bandgap_slope_per_K;  // as stated
  double isc_tempco_per_K = 0;                // relative to the photocurrent at 1000 W/m2
  double isc_tempco_scales_per_K = 0;         // the same where it is stated in ampere; they add up
  double pivot_voltage = 0;                   // per cell: where the diode's current is a parameter
};

}  // namespace lyrefit
