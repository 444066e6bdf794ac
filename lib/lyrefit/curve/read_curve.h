#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

struct ReadOptions {
  // Which curve of a file that holds several: the Index of an ivcurves JSON file, or the number in
  // a table's `sweep` or `curve` column. Unset: the file must hold one curve, or one device swept
  // up and down at one irradiance and temperature, which is read whole.
  std::optional<int> curve;
  std::uintmax_t largest_file_bytes = 64U << 20;
};

// Reads one measured curve from
//   - a table (.csv, .tsv, .txt): comma, semicolon, tab or blanks between the columns, decimal
//   comma
//     with semicolon or tab, lines that start with '#' are comments. Headers are matched without
//     case or punctuation: V, voltage, Volts, voltage_V, voltage (mV), I, current, Amps, current_A,
//     "I [mA]", optional sigma, time, sweep, irradiance, temperature; without a header the first
//     two columns are taken as volt and ampere. Load sign (current of the other sign) is turned.
//   - an IV_Swinger CSV file (Volts, Amps, Watts, Ohms),
//   - an ivcurves JSON file (github.com/cwhanse/ivcurves: numbers may be strings, kelvin),
//   - a folder that holds curve.csv.
// A sidecar NAME.json beside NAME.csv gives cells_in_series, nominal_temperature_C,
// nominal_irradiance_Wm2, bypass_diodes, technology, bandgap_eV, isc_tempco_per_K,
// isc_tempco_A_per_K, current_noise {constant_A, relative}, current_resolution_A. Whatever was not
// said is a sentence in `assumptions`. Every point in every quadrant is kept, in file order. Errors
// carry file, line and column.
Expected<IvCurve> ReadCurve(const std::string& path, const ReadOptions& options = {});

// All curves of an ivcurves JSON file, in file order.
Expected<std::vector<IvCurve>> ReadIvCurvesJson(const std::string& path,
                                                const ReadOptions& options = {});

}  // namespace lyrefit
