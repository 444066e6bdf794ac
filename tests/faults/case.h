#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "faults/injection.h"

namespace faults {

struct Cause {
  std::string name;
  std::vector<std::string> acceptable;  // names that count as right, `name` first
  double strength = 0;
  double misfit = 0;  // of this effect alone, in noise standard deviations
  Size size;
};

// A simulated measurement and its true causes.
struct Case {
  Kind kind = Kind::kForward;
  std::vector<Cause> causes;      // empty: nothing to find
  bool second_diode = false;      // present, but a claim of it does not count
  std::string absorbed = "none";  // an effect that the base model absorbs
  NoiseType noise = NoiseType::kEqual;
  Measurement measurement;
};

// Request for a simulated case. `misfit` is the misfit of each effect alone, in noise standard
// deviations.
struct Request {
  Kind kind = Kind::kForward;
  std::vector<const Injection*> injections;
  double misfit = 12;
  std::optional<NoiseType> noise;  // empty: drawn among the types with independent errors
  std::uint64_t seed = 1;
};

// Draws devices until all effects of the request fit into one. Returns nothing after a dozen draws.
std::optional<Case> MakeCase(const Request& request);

// A case without any identifiable effect: one or two diodes, with or without an absorbed effect.
Case MakeNull(Kind kind, NoiseType noise, std::uint64_t seed);

}  // namespace faults
