#pragma once

#include <array>

#include "trend/years_module.h"

namespace years {

enum Part { kLight, kSeries, kRecombination, kShunt, kMismatch, kParts };
constexpr const char* kPartNames[kParts] = {"light", "resistance_series", "recombination", "shunt",
                                            "mismatch"};

// Power (or energy) of the undamaged module, and what each part takes of it. The parts add up to
// the loss.
struct Split {
  double undamaged = 0;
  std::array<double, kParts> lost{};
  double Total() const;
  void Add(const Split& other, double factor);
};

// The state with the effects of some parts only: bit k of `parts` is part k. Light is common to
// all cells; mismatch is the cover of single cells, the shorted group and uneven damage.
State Only(const State& state, unsigned parts);

// Shapley's average: the part's loss, averaged over all orders in which the effects are switched
// on. The maximum power of the state as it is goes to `maximum`.
Split SplitLoss(const Design& design, const State& state, double suns, double kelvin,
                Operating* maximum);

}  // namespace years
