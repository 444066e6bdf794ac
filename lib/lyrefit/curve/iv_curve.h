#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/assumption.h"

namespace LYREFIT_PUBLIC lyrefit {

// Under what a curve was taken.
struct Conditions {
  double cell_temperature_K = 298.15;
  double irradiance_W_m2 = 1000;
  int cells_in_series = 1;
  int strings_in_parallel = 1;

  // Ns Vt in volt: divides the junction voltage of the whole module in the diode's exponent.
  double ModuleThermalVoltage(ConstantSet constants) const {
    return cells_in_series * ThermalVoltage(cell_temperature_K, constants);
  }
};

// What the person at the bench knows besides the readings; empty where nobody said.
struct DeviceNotes {
  std::string technology;
  std::optional<int> bypass_diodes;  // of a module
  std::optional<double> bandgap_eV;
  std::optional<double> bandgap_slope_per_K;       // relative to the gap at 25 C, as pvlib's dEgdT
  std::optional<double> isc_tempco_per_K;          // relative, per kelvin
  std::optional<double> isc_tempco_A_per_K;        // absolute, where only that is stated
  std::optional<double> current_noise_constant_A;  // standard deviation, constant part
  std::optional<double> current_noise_relative;    // standard deviation, part of |current|
  std::optional<double> current_resolution_A;      // step of the instrument
  std::optional<double> area_cm2;                  // of the cell
  std::optional<double> compliance_A;              // the source was set to give no more
  std::string date;                                // of the measurement, as written
};

// One measured curve in generator sign: delivered current is positive, negative voltages are
// reverse bias. Points stay in the order they were taken. Optional columns are empty or as long as
// voltage_V.
struct IvCurve {
  std::string name;    // "rtc_france"
  std::string source;  // the file it was read from, empty for made curves
  Conditions conditions;
  DeviceNotes notes;
  std::vector<double> voltage_V;
  std::vector<double> current_A;
  std::vector<double> sigma_A;  // standard deviation of each current
  std::vector<double> time_s;
  std::vector<int> sweep;  // which sweep each point is of
  std::vector<double> irradiance_W_m2;
  std::vector<double> temperature_C;
  std::vector<Assumption> assumptions;  // what the reader had to assume
  bool irradiance_known = true;         // false: nobody stated it, the conditions hold a default
  bool temperature_known = true;        // the same of the temperature
  bool cells_known = true;              // false: conditions.cells_in_series is a guess
  bool strings_known = true;            // false: so is conditions.strings_in_parallel
  bool current_unit_known = true;       // false: ampere was assumed
  bool voltage_unit_known = true;       // false: volt was assumed
  bool as_is = false;  // taken as they are: what CheckReadings would refuse becomes a doubt

  // How many points it has.
  std::size_t size() const { return voltage_V.size(); }
};

// Checks what every fit relies on: equal lengths, finite numbers, at least two different voltages,
// positive sigma, a plausible cell temperature (-100..200 C) and at least one cell.
Expected<void> Validate(const IvCurve& curve);

}  // namespace lyrefit
