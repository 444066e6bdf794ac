#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/assumption.h"
#include "lyrefit/curve/key_points.h"

namespace LYREFIT_PUBLIC lyrefit {

// Conditions of a measurement.
struct Conditions {
  double cell_temperature_K = 298.15;
  double irradiance_W_m2 = 1000;
  int cells_in_series = 1;
  int strings_in_parallel = 1;

  // Ns Vt in V: the divisor of the module's junction voltage in the diode's exponent.
  double ModuleThermalVoltage(ConstantSet constants) const {
    return cells_in_series * ThermalVoltage(cell_temperature_K, constants);
  }
};

// Where a curve is measured, which decides what can disturb it.
enum class Setup { kUnknown, kOutdoor, kFlash, kInverter, kLaboratory };

template <>
struct EnumTable<Setup> {
  static constexpr EnumText<Setup> kRows[] = {{Setup::kUnknown, "unknown"},
                                              {Setup::kOutdoor, "outdoor"},
                                              {Setup::kFlash, "flash"},
                                              {Setup::kInverter, "inverter"},
                                              {Setup::kLaboratory, "laboratory"}};
};

// The setup that a text names, "Sun simulator, class AAA": kFlash. Case does not count. kUnknown if
// it names none.
Setup FindSetup(const std::string& text);

// Facts about the device and the instrument beyond the readings; unset if not stated.
struct DeviceNotes {
  Setup setup = Setup::kUnknown;  // of the measurement
  std::string technology;
  std::optional<int> bypass_diodes;      // of the whole device: of all its modules
  std::optional<int> modules_in_series;  // of a string
  std::optional<double> bandgap_eV;
  std::optional<double> bandgap_slope_per_K;       // relative to the gap at 25 C, as pvlib's dEgdT
  std::optional<double> isc_tempco_per_K;          // relative, per K
  std::optional<double> isc_tempco_A_per_K;        // absolute, if only that is stated
  std::optional<double> current_noise_constant_A;  // standard deviation, constant part
  std::optional<double> current_noise_relative;    // standard deviation, as a fraction of |current|
  std::optional<double> current_resolution_A;      // current step of the instrument
  std::optional<double> area_cm2;                  // of the cell
  std::optional<double> compliance_A;              // current limit set at the source
  // Light that is stated in lux. No irradiance follows without its spectrum, hence no efficiency.
  std::optional<double> illuminance_lux;
  // Light of the top and of the bottom junction of a tandem, as shares of their light under the
  // spectrum that all curves refer to.
  std::optional<double> light_top;
  std::optional<double> light_bottom;
  std::string date;                     // of the measurement, as written
  std::optional<double> scan_rate_V_s;  // of the sweep
  std::optional<double> elapsed_h;      // hours of operation or light soaking before the sweep
};

// Whether a word for a technology means thin films or a tandem. Any other word and none mean
// silicon. Case does not count.
bool IsThinFilm(const std::string& technology);

// Junctions in series in each cell, by a word for the technology: 3 of "triple", 2 of "tandem",
// "micromorph" or PVsyst's "mtuCSi_aSiH", else 1. Case does not count.
int JunctionsPerCell(const std::string& technology);

// Where a file states the conditions of a curve: "line 9", "\"cells_in_series\" of string.json". Empty:
// it does not state them.
struct ConditionSources {
  std::string cells;          // of the cells in series
  std::string temperature;    // of the cell temperature
  std::string irradiance;     // of the irradiance
  std::string bypass_diodes;  // of the bypass diodes
  std::string technology;     // of the technology
  std::string setup;          // of the setup of the measurement
};

// A result that the file states for a sweep, such as Voc.
struct StatedResult {
  int sweep = 0;       // its place among the sweeps of the curve, from 0
  std::string label;   // as written, with its unit: "Jsc [mA/cm2]"
  double value = 0;    // as written
  std::string source;  // where: "line 7 '...'"
};

// One measured curve in generator sign: delivered current is positive, negative voltages are
// reverse bias. Points are in measurement order. Optional columns are empty or as long as
// voltage_V.
struct IvCurve {
  std::string name;    // "rtc_france"
  std::string source;  // the file it was read from; empty for simulated curves
  Conditions conditions;
  DeviceNotes notes;
  std::vector<double> voltage_V;
  std::vector<double> current_A;
  std::vector<double> sigma_A;  // standard deviation of each current
  std::vector<double> time_s;
  std::vector<int> sweep;  // number of the sweep of each point
  std::vector<double> irradiance_W_m2;
  std::vector<double> temperature_C;
  // Key points that a test laboratory states in place of a sweep; NaN: not stated. The readings
  // repeat them.
  std::optional<KeyPoints> key_points;
  std::vector<StatedResult> stated;     // results that the file states
  ConditionSources stated_in;           // where the file states the conditions
  std::vector<Assumption> assumptions;  // assumptions of the reader
  bool irradiance_known = true;         // false: not stated, conditions hold a default
  bool temperature_known = true;        // false: not stated, conditions hold a default
  bool cells_known = true;              // false: conditions.cells_in_series is a guess
  bool strings_known = true;            // false: conditions.strings_in_parallel is a guess
  bool current_unit_known = true;       // false: ampere was assumed
  bool voltage_unit_known = true;       // false: volt was assumed
  // Set for a Suns-Voc trace: the light, as a photocurrent, at which its current is 0. A reading is
  // an open-circuit voltage at the photocurrent suns_voc_A - current_A.
  std::optional<double> suns_voc_A;
  bool pseudo_current = false;  // of a Suns-Voc trace: its readings were stated as currents
  bool per_area = false;  // the currents are those of 1 cm2: densities whose area is not stated
  bool as_is = false;     // turns refusals of CheckReadings into doubts

  // Number of points.
  std::size_t size() const { return voltage_V.size(); }
};

// Gives a curve without readings stated key points, and the readings that they are: (0, Isc),
// (Vmp, Imp) and (Voc, 0), without those of which a value is NaN.
void TakeKeyPoints(const KeyPoints& points, IvCurve* curve);

// Checks the preconditions of every fit: equal lengths, finite numbers, at least two different
// voltages, positive sigma. The conditions must have a cell temperature of -100 .. 200 C, an
// irradiance from 0 W/m2 up, at least one cell and one string. The error names the first violation.
Expected<void> Validate(const IvCurve& curve);

}  // namespace lyrefit
