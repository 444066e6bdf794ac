#pragma once

#include "faults/field_module.h"
#include "faults/random.h"

namespace faults::field {

// Design of a module and its irradiance and temperature.
struct Make {
  bool half_cut = false;
  double suns = 1;
  double kelvin = 298.15;
  double open_circuit_V = 0.64;  // of a cell at 1000 W/m2 and 25 C
};

struct Drawn {
  Make make;
  Module module;  // without a fault
};

enum class Uniformity { kSingleDiode, kDoubleDiode, kEveryCellItsOwn };

// kSingleDiode and kDoubleDiode: all cells are equal.
Drawn DrawModule(Uniformity uniformity, Random* random);

// A module type. The properties that all modules of the type share are drawn from `seed`.
struct ModuleType {
  std::uint64_t seed = 1;
  int cells = 60;
  int groups = 3;
  double current = 9.5;  // A at 1000 W/m2 and 25 C
  double open_circuit_V = 0.65;
};

// A module of the type at the given irradiance and temperature. Every cell has its own parameters.
Module DrawOfType(const ModuleType& type, double suns, double kelvin, Random* random);

}  // namespace faults::field
