// Experimental: may change in a minor version (data/stable).
#pragma once

#include <optional>
#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"

namespace LYREFIT_PUBLIC lyrefit {

// One point of a measurement, in internal units: voltages per cell in volt, currents in units of
// the measurement's current scale (about Isc), conductances in scales per volt of a cell.
struct Reading {
  double voltage = 0;        // per cell, V
  double current = 0;        // in current scales
  double irradiance = 1;     // sensor value, in suns (1000 W/m2)
  double temperature_K = 0;  // of the cell, sensor value
  double x = 0;              // time within the measurement, scaled to -1/2 .. 1/2
  double rate = 0;           // dV/dt in units of the measurement's rate scale, signed
  int curve = 0;             // position in the set
  int index = 0;             // position in its curve
  bool dark = false;         // its curve is dark
  bool suns_voc = false;     // of a Suns-Voc trace: at open circuit, without series resistance
  int segment = 0;           // number of the monotone voltage sweep, over the whole set
  // For a mean of neighbouring readings: their number, and the mean square of their deviations from
  // it (in squared current scales, without the curve's own slope).
  double weight = 1;
  double scatter = 0;
};

// Scales of a measurement.
struct ReadingScale {
  double current_A = 1;
  int cells = 1;                 // in series
  int strings = 1;               // in parallel
  double rate_V_per_s = 1;       // per cell; per reading where no times were recorded
  double span_s = 0;             // duration; 0 where no times were recorded
  bool times = false;            // times were recorded
  double saturation_2_unit = 1;  // see Cell
  double reach_V = 1;            // largest |voltage| per cell

  // Resistance of the device that drops 1 V per cell at 1 scale.
  double resistance_ohm() const { return cells / current_A; }
};

// Properties of a measurement: they decide which effects it can show.
struct DataTraits {
  int curves = 1;                 // each with its own conditions
  bool single = true;             // one curve only (any number of sweeps), or one beside Suns-Voc
  bool reverse = false;           // points well below 0 V
  bool beyond_voc = false;        // points of negative current in the light
  bool up_down = false;           // both directions under the same conditions
  bool dark = false;              // a dark curve beside a lit one
  bool only_dark = false;         // dark curves only
  bool suns_voc = false;          // a Suns-Voc trace beside another curve
  int irradiance_levels = 1;      // of lit curves
  int temperature_levels = 1;     // of all curves
  bool module = false;            // more than one cell in series
  int substrings = 0;             // number of bypass groups; 0: none, or unknown
  bool bypass_known = false;      // that number is stated; else a string has the usual one
  int cells = 1;                  // used in the computation
  int stated_cells = 1;           // as stated, or a reader's default
  bool cells_known = true;        // the number of cells is stated
  Setup setup = Setup::kUnknown;  // of the measurement
  // The highest open-circuit voltage of a cell, as its technology has it under the brightest light; 0:
  // no limit is known.
  double most_open_circuit = 0;
  bool bandgap_known = true;   // the band gap is stated
  bool tempco_known = true;    // the temperature coefficient of Isc is stated
  double lowest_voltage = 0;   // per cell
  double highest_voltage = 0;  // per cell
  double open_circuit = 0;     // estimate of Voc per cell; 0: no estimate
  double largest_current = 0;  // of lit curves, in scales
  double thermal_voltage = 0;  // k T / q at the reference
  int readings = 0;
  std::vector<double> turns;       // x at which a sweep up and down turns
  std::vector<double> step_times;  // x of possible irradiance steps, between two readings
  // Possible ends of a measuring range: currents between two readings of a sweep, in current
  // scales.
  std::vector<double> range_currents;
};

// Numbers of bypass groups of a string of so many cells that nobody states: that of modules of 60, 72,
// 54 and 66 cells with three groups each, as far as the cells make whole modules, else of 20 cells a
// group; a diode has 18 to 24 cells of silicon in the field (Vieira et al. 2020,
// doi:10.3390/en13102472). Empty: so few cells are one module.
std::vector<int> UsualSubstrings(int cells);

// Number of bypass groups used: as stated, else usual for modules of that many cells.
int SubstringsOf(const DataTraits& traits);

// All points of a measurement, and its common properties.
struct Readings {
  std::vector<Reading> points;
  ReadingScale scale;
  DataTraits traits;
  double reference_temperature_K = 298.15;  // of the parameters
  double bandgap_eV = 1.121;
  std::optional<double> bandgap_slope_per_K;  // as stated
  double isc_tempco_per_K = 0;                // relative to the photocurrent at 1000 W/m2
  double isc_tempco_scales_per_K = 0;         // absolute part, if stated in A/K; both add up
  double pivot_voltage = 0;                   // V per cell, about Voc
};

// The measurement with one reading, whose conditions are those of the brightest light.
Readings InBrightestLight(const Readings& measured);

}  // namespace lyrefit
