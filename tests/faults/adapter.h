#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "faults/scene.h"

namespace faults {

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
  double probability = 1;
  bool by_values = false;
  std::vector<Strength> strengths;
};

struct Answer {
  std::string error;  // empty: no error
  std::vector<Claim> claims;
  double seconds = 0;
};

// Noise and departure that the diagnosis assumes: low instrument noise (laboratory) or field
// conditions.
enum class Mode { kLaboratory, kField };

// Runs the diagnosis under test on the readings. It gets no information on the hidden effects.
// `second_diode`: the base model is the double-diode model.
Answer Ask(const Measurement& measurement, int number, double probability, std::uint64_t seed,
           bool second_diode = false, Mode mode = Mode::kLaboratory);

}  // namespace faults
