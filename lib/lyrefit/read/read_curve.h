// Experimental: may change in a minor version (data/stable).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"

namespace LYREFIT_PUBLIC lyrefit {

// Settings for details that a file does not state.
struct ReadOptions {
  // Selects a curve of a file that holds several. The number is the Index of an ivcurves JSON file,
  // the number in a table's `sweep` or `curve` column, or the number of a table among several below
  // each other. Unset: the file must hold one curve, or sweeps up and down at one irradiance and
  // temperature, which are read together.
  std::optional<int> curve;
  // Selects one of several currents, or voltage-current pairs, side by side. The value is its place
  // (from 1), the name of its current or the number of its pixel.
  std::string column;
  // Select the columns of voltage and current by name or place (from 1), if the reader does not
  // recognise the names.
  std::string voltage_column;
  std::string current_column;
  // Units of voltage and current ("mA", "mA/cm2"), if the file names none or a wrong one.
  std::string voltage_unit;
  std::string current_unit;
  // Leaves out rows whose voltage or current is empty, NaN, a word such as "NA", or an overflow
  // code such as 9.91e37. `assumptions` counts them. False: the first such row is an error.
  bool skip_missing = false;
  std::optional<double> area_cm2;  // of the cell; converts current densities to currents
  // Current densities without an area are the currents of 1 cm2 (IvCurve::per_area), no error.
  bool per_area = false;
  std::optional<double> isc_A;  // at one sun; makes a curve of a Suns-Voc trace
  // Keeps readings at a stated current limit, for a diagnosis that names the limit. False: they are
  // left out, since no model follows them, and `assumptions` counts them.
  bool keep_limited = false;
  // For OpenBatch only: an item is a cell with all its curves (BatchCurve::more), not a curve.
  bool whole_cells = false;
  // For OpenBatch only: an item is a file that is not read (BatchCurve::file): the sweeps of a device
  // over time.
  bool whole_files = false;
  std::uintmax_t largest_file_bytes = 64U << 20;  // larger files are an error
};

inline constexpr OptionRow<ReadOptions> kReadOptionTable[] = {
    OptionRow<ReadOptions>("Reading"),
    {"curve", "INDEX", "which curve of a file that holds several", &ReadOptions::curve,
     OptionTrait::kNoFlag},
    {"column", "NAME|N", "which of several currents, or pairs of voltage and current, side by side",
     &ReadOptions::column},
    {"voltage-column", "NAME|N",
     "the column of the voltage, by name or number, where its name does not tell",
     &ReadOptions::voltage_column},
    {"current-column", "NAME|N", "the same for the current", &ReadOptions::current_column},
    {"voltage-unit", "UNIT", "its unit, where the file names none: V, mV, uV or kV",
     &ReadOptions::voltage_unit},
    {"current-unit", "UNIT", "that of the current: A, mA, uA, nA, kA, mA/cm2, A/m2, ...",
     &ReadOptions::current_unit},
    {"skip-missing", "",
     "leave out rows whose voltage or current is empty, NaN or an overflow code",
     &ReadOptions::skip_missing},
    {"area-cm2", "A", "area of the cell in cm2, which makes currents of current densities",
     &ReadOptions::area_cm2, 1e-9, 1e9, OptionTrait::kQuiet},
    {"isc-A", "I", "short-circuit current at one sun, which makes a curve of a Suns-Voc trace",
     &ReadOptions::isc_A, 1e-12, 1e6, OptionTrait::kQuiet},
};

// Reads one measured curve from one of these sources:
//   - a table (.csv, .tsv, .txt, .dat, .asc, .dta, .mpt or any other name). Columns are separated
//     by comma, semicolon, tab or blanks; a decimal comma needs semicolon or tab. Lines that start
//     with '#' or '%' are comments. The encoding is UTF-8, UTF-16 or Windows-1252.
//     Headers are matched without case or punctuation: V, voltage, Volts, voltage_V,
//     voltage (mV), Potential, Ewe, Vf, Vmeas, I, current, Amps, current_A, "I [mA]", Im, Idc, J,
//     "Current density (mA/cm2)", optional sigma, time, sweep, irradiance, temperature. If no name
//     is recognised, the only columns in volt and in ampere are used. Without a header the first
//     two columns are volt and ampere. Currents in load sign (opposite sign) are negated. Current
//     densities need the cell's area.
//     Lines before the header that clearly state irradiance, cell temperature, cells, area,
//     compliance or date are read; `assumptions` lists others that hold a number. Columns or tables
//     that differ by direction are sweeps of one curve. Text below the last row is ignored, with an
//     assumption. Readings at a stated compliance are left out (keep_limited),
//   - JSON: lists, records, pairs or named lists of voltages and currents under any of those names,
//     as pandas, NOMAD (V, mA/cm2) and PV_circuit_model write them, and ivcurves files
//     (github.com/cwhanse/ivcurves: numbers may be strings, kelvin),
//   - a folder that holds curve.csv, or a table of the folder's own name, as IV_Swinger writes it.
// A sidecar NAME.json beside NAME.csv supplies cells_in_series, nominal_temperature_C,
// nominal_irradiance_Wm2, area_cm2, bypass_diodes, modules_in_series, technology, setup (of the
// measurement: outdoor, flash, inverter or laboratory), bandgap_eV (or EgRef), bandgap_slope_per_K (or
// dEgdT), isc_tempco_per_K, isc_tempco_A_per_K, current_noise {constant_A, relative},
// current_resolution_A, light_top, light_bottom (of a tandem's junctions, shares of their reference
// light).
// A report of `lyrefit fit` under this name supplies its conditions. `assumptions` has a sentence
// for each condition that is not stated. The points of every quadrant are kept, in file order.
// Errors carry file, line and column.
Expected<IvCurve> ReadCurve(const std::string& path, const ReadOptions& options = {});

// Reads a curve from a text without a file, such as standard input: JSON, or else a table without a
// sidecar. `name` is used as the curve's name and in errors.
Expected<IvCurve> ReadCurveText(std::string text, const std::string& name,
                                const ReadOptions& options = {});

// A column of a table and its interpretation.
struct ColumnNote {
  int place = 0;                        // from 1
  std::string name;                     // as in the file
  std::string use;                      // "voltage", "current of curve 2", "not used", ...
  std::string unit;                     // as recognised; empty if the name has none
  int numbers = 0;                      // rows that have a number here
  double least = kUnknown;              // of the numbers, as written
  double largest = kUnknown;            // of the numbers, as written
  std::vector<std::string> first = {};  // its first values, as written
};

// Columns of a table, for a user who must select among them, also where the header is not
// understood. Errors: a folder without a curve of its own, an unreadable file, a file without a
// table.
Expected<std::vector<ColumnNote>> ListColumns(const std::string& path,
                                              const ReadOptions& options = {});

}  // namespace lyrefit
