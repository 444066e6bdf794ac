#pragma once

namespace faults {

// Effects that act besides the plain device; the default values mean none. Voltages and resistances
// are those of one cell. The time x runs from -1/2 to 1/2 over the measurement.
struct Effects {
  // device
  double shunt_strength = 0;  // A/V^m
  double shunt_exponent = 2;
  double breakdown = 0;  // S
  double breakdown_voltage = -20;
  double collection = 0;  // V
  double photoshunt = 0;  // S at 1000 W/m2
  bool photoshunt_exponential = false;
  double inverse_contact = 0;  // 1/A, inverse saturation current of the blocking contact
  double lumped_drop = 0;      // V/A^2
  double far_ohm = 0;          // of the far part of a cell, as if all of it were behind it
  double far_share = 0.5;      // of the area
  double shade_depth = 0;
  int shaded_substrings = 1;
  double bypass_drop = 0.5;  // V of one diode
  bool bypass_ideal = false;
  double mismatch_deficit = 0;
  double mismatch_share = 0.5;
  // sweep
  double drift = 0;
  double step = 0;
  double step_at = 0;
  double dip = 0;
  double dip_at = 0;
  double dip_width = 0.05;
  double temperature_drift_K = 0;
  double capacitance = 0;  // F of a cell, the part that does not depend on voltage
  double diffusion_s = 0;  // charge per diode current
  double skew_s = 0;       // the voltage is taken this much earlier than the current
  // instruments
  double clip_A = 0;  // 0: none
  double current_offset_A = 0;
  double voltage_offset = 0;
  double lead_ohm = 0;
  double current_gain = 0;
  // conditions
  double temperature_offset_K = 0;
  double temperature_gradient_K = 0;  // at 1000 W/m2
  double sensor_bend = 0;
  double sensor_offset = 0;  // suns
  double sensor_gain = 0;
  double bandgap_eV = 0;
  double isc_tempco_per_K = 0;
};

}  // namespace faults
