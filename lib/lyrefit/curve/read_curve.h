#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"

namespace LYREFIT_PUBLIC lyrefit {

// What a file does not say of itself.
struct ReadOptions {
  // Which curve of a file that holds several: the Index of an ivcurves JSON file, the number in a
  // table's `sweep` or `curve` column, or the number of the table in a file that holds several, one
  // below the other. Unset: the file must hold one curve, or one device swept up and down at one
  // irradiance and temperature, which is read whole.
  std::optional<int> curve;
  // Which of several currents, or pairs of voltage and current, that stand side by side: its place
  // (from 1), the name of its current or the number of its pixel.
  std::string column;
  // Which column holds the voltage or the current, by its name or its place (from 1), where names
  // do not tell.
  std::string voltage_column;
  std::string current_column;
  // The unit of the voltage or of the current ("mA", "mA/cm2"), where the file names none or a
  // wrong one.
  std::string voltage_unit;
  std::string current_unit;
  // Leaves out rows without a reading: their voltage or current is empty, NaN, a word such as "NA",
  // or a number such as 9.91e37, which instruments write for an overflow. `assumptions` counts
  // them. False: the first of them is an error.
  bool skip_missing = false;
  std::optional<double> area_cm2;  // of the cell; makes currents of current densities
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
};

// Reads one measured curve from
//   - a table (.csv, .tsv, .txt, .dat, .asc, .dta, .mpt or any other name): comma, semicolon, tab
//     or blanks between the columns, decimal comma with semicolon or tab, lines that start with '#'
//     or '%' are comments, UTF-8, UTF-16 or Windows-1252. Headers are matched without case or
//     punctuation: V, voltage, Volts, voltage_V, voltage (mV), Potential, Ewe, Vf, Vmeas, I,
//     current, Amps, current_A, "I [mA]", Im, Idc, J, "Current density (mA/cm2)", optional sigma,
//     time, sweep, irradiance, temperature; where no name is known, the only columns in volt and in
//     ampere count. Without a header the first two columns are taken as volt and ampere. Load sign
//     (current of the other sign) is turned. Current densities need the cell's area. Lines before
//     the header that clearly state irradiance, cell temperature, number of cells, area, compliance
//     or date are read, others that hold a number are shown in `assumptions`. A second table below
//     the first is a further sweep; text below the last row is left and said.
//   - JSON: lists of voltages and currents under any of those names, as pandas writes tables
//     (records, columns, split, index), as NOMAD stores current-voltage measurements (V, mA/cm2),
//     and ivcurves files (github.com/cwhanse/ivcurves: numbers may be strings, kelvin),
//   - a folder that holds curve.csv, or a table of the folder's own name, as IV_Swinger writes it.
// A sidecar NAME.json beside NAME.csv gives cells_in_series, nominal_temperature_C,
// nominal_irradiance_Wm2, area_cm2, bypass_diodes, technology, bandgap_eV, bandgap_slope_per_K,
// isc_tempco_per_K, isc_tempco_A_per_K, current_noise {constant_A, relative}, current_resolution_A;
// a report of `lyrefit fit` in its place gives its conditions. Whatever was not said is a sentence
// in `assumptions`. Every point in every quadrant is kept, in file order. Errors carry file, line
// and column.
Expected<IvCurve> ReadCurve(const std::string& path, const ReadOptions& options = {});

// The same from a text that is no file, such as standard input: JSON where it is that, else a table
// without a sidecar. `name` names the curve and stands in the errors.
Expected<IvCurve> ReadCurveText(std::string text, const std::string& name,
                                const ReadOptions& options = {});

// A column of a table and what it was taken for.
struct ColumnNote {
  int place;         // from 1
  std::string name;  // as in the file
  std::string use;   // "voltage", "current of curve 2", "not used", ...
};

// The columns of a table, for whoever has to choose among them. Errors: a folder without a curve of
// its own, a file that cannot be read or holds no table.
Expected<std::vector<ColumnNote>> ListColumns(const std::string& path,
                                              const ReadOptions& options = {});

// All curves of an ivcurves JSON file, in file order. Errors: what ReadCurve refuses; an index that
// occurs twice; one curve that cannot be read refuses the file.
Expected<std::vector<IvCurve>> ReadIvCurvesJson(const std::string& path,
                                                const ReadOptions& options = {});

}  // namespace lyrefit
