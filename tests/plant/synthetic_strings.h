#pragma once

#include <string>

#include "faults/field_tracer.h"
#include "plant/synthetic_plant.h"

namespace made {

// The strings of the plant one by one: what they are, and how they are measured.

inline constexpr int kCellsOfModule = 60;
inline constexpr int kGroupsOfModule = 3;

struct KeyPoints {
  double isc, voc, imp, vmp;
  double pmax() const { return imp * vmp; }
};

// A typical module of the plant's type.
KeyPoints ModuleAt(double suns, double celsius);

// A string that is measured. Its modules are those of the place `who`, and sky and sensor those of
// the place `where`; both differ where strings are exchanged.
struct Slot {
  int who = 0, where = 0;
  std::string id, partner = "";
  const PlantFault* fault = nullptr;
  const PlantChange* change = nullptr;
};

struct Strung {
  std::string id, date;
  double irradiance_Wm2 = 0, temperature_C = 0;  // as shown by the sensors
  faults::field::Readings readings;
  double loss_percent = 0;  // loss of maximum power by the fault
};

std::string IdOf(int place);
Strung Measure(const Slot& slot, const PlantRequest& request);

// Largest power of the string in W at 1000 W/m2 and 25 C, with its fault and its change.
double StandardPower(const Slot& slot, const PlantRequest& request);

// printf into a text of at most 400 letters.
__attribute__((format(printf, 1, 2))) std::string Text(const char* format, ...);

}  // namespace made
