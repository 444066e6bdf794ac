#pragma once

#include "hidden/field_module.h"
#include "hidden/random.h"

namespace hidden::field {

// What a module is made as, and what weather it stands in.
struct Make {
  bool half_cut = false;
  double suns = 1;
  double kelvin = 298.15;
  double open_circuit_V = 0.64;  // of a cell at 1000 W/m2 and 25 C
};

struct Drawn {
  Make make;
  Module module;  // healthy
};

enum class Uniformity { kSingleDiode, kDoubleDiode, kEveryCellItsOwn };

// kSingleDiode and kDoubleDiode: every cell the same.
Drawn DrawModule(Uniformity uniformity, Random* random);

// What all modules of one make have in common is drawn from `seed`.
struct ModuleType {
  std::uint64_t seed = 1;
  int cells = 60;
  int groups = 3;
  double current = 9.5;  // A at 1000 W/m2 and 25 C
  double open_circuit_V = 0.65;
};

// One of them, every cell its own, under this light and warmth.
Module DrawOfType(const ModuleType& type, double suns, double kelvin, Random* random);

}  // namespace hidden::field
