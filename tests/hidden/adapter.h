#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hidden/scene.h"

namespace hidden {

struct Strength {
  std::string symbol;
  std::string unit;
  double value = 0;
  double low = 0;
  double high = 0;
  std::string name = "";
};

struct Claim {
  std::string id;
  std::vector<std::string> equivalents;
  double corrected_p = 1;
  bool by_values = false;
  std::vector<Strength> strengths;
};

struct Answer {
  std::string error;  // empty: none
  std::vector<Claim> claims;
  double seconds = 0;
};

// How it is asked: for readings of little noise at a bench, or as in the field.
enum class Mode { kLaboratory, kField };

// Hands the readings, and no word of what is in them, to the diagnosis under test.
// `second_diode`: the base model has two diodes.
Answer Ask(const Measurement& measurement, int number, double level, std::uint64_t seed,
           bool second_diode = false, Mode mode = Mode::kLaboratory);

}  // namespace hidden
