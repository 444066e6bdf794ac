#pragma once

#include "faults/random.h"

namespace faults {

constexpr double kBoltzmannOverCharge = 8.617333262e-5;  // V/K
constexpr double kReferenceK = 298.15;

// A device at 1000 W/m2 and 25 C; all figures of one of its equal cells, in A, V, ohm and S.
struct Device {
  bool thin_film = false;
  int cells = 1;
  int substrings = 0;  // each with a bypass diode; 0: none
  double photocurrent = 1;
  double saturation = 1e-9;
  double ideality = 1.2;
  double resistance = 0.01;
  double conductance = 0.01;
  double saturation_2 = 0;  // n = 2
  double open_circuit = 0.6;
  double bandgap_eV = 1.121;
  double isc_tempco_per_K = 5e-4;
};

struct DeviceWish {
  bool module = false;
  bool bypass = true;  // modules only
  bool second_diode = false;
  bool crystalline = false;  // no thin film
};

Device DrawDevice(const DeviceWish& wish, Random* random);

// Sets the first diode so that the open-circuit voltage stays while the second one is `saturation`.
// False where the second diode alone carries more than 97 % of the current there.
bool SetSecondDiode(double saturation, Device* device);

}  // namespace faults
