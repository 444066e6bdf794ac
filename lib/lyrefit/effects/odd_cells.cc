#include "lyrefit/effects/odd_cells.h"

#include <algorithm>
#include <cmath>

namespace lyrefit {
namespace {

// Sum of the distances of the steps from the ends of the substrings, in parts of the voltage. A
// step is found a little below such an end: bypass diodes take some voltage, and so does the knee.
double Distance(const std::vector<double>& steps, const ThreeShares& shares) {
  constexpr double kBelow = 0.05;
  double sum = 0;
  for (std::size_t k = 0; k + 1 < steps.size(); ++k) {  // the last one is open circuit
    const double place = steps[k] + kBelow;
    sum += std::min(std::fabs(place - shares[0]), std::fabs(place - shares[0] - shares[1]));
  }
  return sum;
}

}  // namespace

std::vector<ThreeShares> UnlikeShares(const CurveShape& shape, const DataTraits& traits,
                                      double nearly) {
  const bool three =
      traits.substrings == 3 || (traits.substrings == 0 && SubstringsOf(traits) == 3);
  std::vector<ThreeShares> unlike;
  if (!three || traits.cells % 4 != 0) return unlike;
  const std::vector<double> steps = StairsOf(shape).steps;
  const double alike = Distance(steps, {1.0 / 3, 1.0 / 3, 1.0 / 3}) + nearly;
  for (const ThreeShares& shares :
       {ThreeShares{0.5, 0.25, 0.25}, {0.25, 0.5, 0.25}, {0.25, 0.25, 0.5}}) {
    if (Distance(steps, shares) < alike) unlike.push_back(shares);
  }
  return unlike;
}

}  // namespace lyrefit
