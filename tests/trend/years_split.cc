#include "trend/years_split.h"

#include <vector>

namespace years {
namespace {

bool Has(unsigned parts, Part part) { return (parts >> part & 1) != 0; }

unsigned Active(const State& state) {
  unsigned parts = 0;
  if (state.light != 1) parts |= 1u << kLight;
  if (state.series != 1 || state.series_ohm != 0) parts |= 1u << kSeries;
  if (state.recombination != 1) parts |= 1u << kRecombination;
  if (state.shunt != 1) parts |= 1u << kShunt;
  if (state.covered || state.shorted >= 0 || state.uneven) parts |= 1u << kMismatch;
  return parts;
}

// Share of the orders in which exactly `before` of the other players come before a player.
double Share(int before, int players) {
  double orders = 1;  // players! / (before! (players - before - 1)!)
  for (int i = before + 1; i <= players; ++i) orders *= i;
  for (int i = 2; i < players - before; ++i) orders /= i;
  return 1 / orders;
}

int Count(unsigned parts) {
  int count = 0;
  for (; parts != 0; parts &= parts - 1) ++count;
  return count;
}

}  // namespace

double Split::Total() const {
  double sum = 0;
  for (const double part : lost) sum += part;
  return sum;
}

void Split::Add(const Split& other, double factor) {
  undamaged += factor * other.undamaged;
  for (int k = 0; k < kParts; ++k) lost[k] += factor * other.lost[k];
}

State Only(const State& state, unsigned parts) {
  State only;
  if (Has(parts, kLight)) only.light = state.light;
  if (Has(parts, kSeries)) only.series = state.series, only.series_ohm = state.series_ohm;
  if (Has(parts, kRecombination)) only.recombination = state.recombination;
  if (Has(parts, kShunt)) only.shunt = state.shunt;
  if (Has(parts, kMismatch)) {
    only.covered = state.covered;
    only.cover = state.cover;
    only.shorted = state.shorted;
    only.uneven = state.uneven;
  }
  return only;
}

Split SplitLoss(const Design& design, const State& state, double suns, double kelvin,
                Operating* maximum) {
  const unsigned active = Active(state);
  const int players = Count(active);
  std::array<double, 1u << kParts> power{};
  for (unsigned parts = 0; parts <= active; ++parts) {
    if ((parts & ~active) != 0) continue;
    *maximum = LitModule(design, Only(state, parts), suns, kelvin).MaximumPower();
    power[parts] = maximum->power();
  }
  Split split;
  split.undamaged = power[0];
  for (int k = 0; k < kParts; ++k) {
    const unsigned own = 1u << k;
    for (unsigned others = 0; (active & own) != 0 && others <= active; ++others) {
      if ((others & (~active | own)) != 0) continue;
      split.lost[k] += Share(Count(others), players) * (power[others] - power[others | own]);
    }
  }
  return split;
}

}  // namespace years
