#pragma once

#include <cmath>
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
  std::vector<std::string> beside = {};  // findings that the verdict says it may be as well
};

// Probability of a finding as the only one, before anything is named.
struct Stated {
  std::string id;      // "none": no finding, or none above the floors
  double probability;  // of a finding above the floors
};

// Power to gain without all causes, in W. Where only "at least" is known, the value is NaN.
struct Recoverable {
  double value = NAN, low = NAN, high = NAN;
};

struct Answer {
  std::string error;  // empty: no error
  std::vector<Claim> claims;
  Recoverable recoverable;
  std::vector<Stated> stated;
  double seconds = 0;
};

// Noise and departure that the diagnosis assumes: low instrument noise (laboratory) or field
// conditions.
enum class Mode { kLaboratory, kField };

// Runs the diagnosis under test on the readings. It gets no information on the hidden effects.
// `second_diode`: the base model is the double-diode model.
Answer Ask(const Measurement& measurement, int number, double probability, std::uint64_t seed,
           bool second_diode = false, Mode mode = Mode::kLaboratory);
// The same for a file, with the settings of the command.
Answer AskFile(const std::string& path, double probability);
// The finding that an effect is reported as.
std::string FindingOf(const std::string& id);
// How common the findings of an effect are taken to be.
double PriorOf(const std::string& id, bool module, Mode mode);

}  // namespace faults
