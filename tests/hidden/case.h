#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hidden/hide.h"

namespace hidden {

struct Cause {
  std::string name;
  std::vector<std::string> acceptable;  // itself first
  double strength = 0;
  double misfit = 0;  // alone, in noise units
  Size size;
};

// A measurement with its answer.
struct Case {
  Kind kind = Kind::kForward;
  std::vector<Cause> causes;      // empty: nothing to find
  bool second_diode = false;      // there, but not the question
  std::string absorbed = "none";  // there, but nothing shows it
  NoiseType noise = NoiseType::kEqual;
  Measurement measurement;
};

// The first effect of the list is as strong as `misfit` says, and so is every other one alone.
struct Request {
  Kind kind = Kind::kForward;
  std::vector<const Hide*> hides;
  double misfit = 12;
  std::optional<NoiseType> noise;  // otherwise any of independent readings
  std::uint64_t seed = 1;
};

// Draws devices until one has room for what is asked; nothing after a dozen.
std::optional<Case> MakeCase(const Request& request);

// Nothing identifiable inside: devices of one or two diodes, with or without what is absorbed.
Case MakeNull(Kind kind, NoiseType noise, std::uint64_t seed);

}  // namespace hidden
