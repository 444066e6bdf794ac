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

}  // namespace hidden::field
