#include "lyrefit/diagnose/prefer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "lyrefit/law/curve_shape.h"

namespace lyrefit {
namespace {

double Value(const Rival& rival, int parameter) {
  return rival.fit.p[rival.fit.p.size() - rival.score.effect->parameters.size() + parameter];
}

bool StrengthIsAtBound(const Rival& rival) {
  constexpr double kSlack = 1e-3;
  const Effect& effect = *rival.score.effect;
  if (effect.parameters.empty()) return false;
  const EffectParameter& strength = effect.parameters.front();
  const double slack = kSlack * (strength.upper - strength.lower);
  return Value(rival, 0) > strength.upper - slack ||
         Value(rival, 0) < strength.lower + 1e-3 * slack;
}

// Causes among unlike cells, the simplest first.
constexpr std::array<std::string_view, 7> kSimplest = {
    "shading", "substrings", "mismatch", "leaky_cell", "scatter", "weak_cell", "bypass_open"};

int Complexity(const Effect& effect) {
  const auto at = std::find(kSimplest.begin(), kSimplest.end(), effect.id);
  return static_cast<int>(at - kSimplest.begin());
}

// Bends to whatever shape there is: anything that happens during a sweep in one direction, else a
// moment.
bool IsGeneric(const Readings& readings, const Effect& effect) {
  return readings.traits.up_down ? effect.momentary : effect.where == Where::kSweep;
}

}  // namespace

bool LightMoved(const Readings& readings) {
  constexpr double kLeast = 0.01;
  if (!readings.traits.single || readings.traits.only_dark) return false;
  double lowest = 1e300, rise = 0;
  for (const double current : ShapeOf(readings).current) {
    lowest = std::min(lowest, current);
    rise = std::max(rise, current - lowest);
  }
  return rise > kLeast;
}

bool HasPossibleSize(const Readings& readings, const LawFit& before, const Rival& rival) {
  constexpr double kMostExponent = 4.99, kMostKelvin = 3, kLeastCell = 0.9, kLeastIdeality = 0.9,
                   kMostIdeality = 2.5;
  const Effect& effect = *rival.score.effect;
  const std::string_view id = effect.id;
  if (StrengthIsAtBound(rival)) return false;
  if (id == "temp_drift" && std::fabs(Value(rival, 0)) > kMostKelvin) return false;
  // An exponent at its end is a diode's exponential.
  if (id == "nonohmic_shunt" && Value(rival, 1) > kMostExponent) return false;
  if (id == "mismatch" && Value(rival, 1) * readings.traits.cells < kLeastCell) return false;
  const auto possible = [&](const LawFit& fit) {
    const double n = fit.p[kBaseIdeality];
    return n > kLeastIdeality && n < kMostIdeality;
  };
  return possible(rival.fit) || !possible(before);
}

std::size_t Prefer(const Readings& readings, const std::vector<Rival>& rivals) {
  constexpr double kAboutAsMuch = 0.9, kHardlyMore = 0.98;
  const auto first = [&](auto is_wanted) {
    return static_cast<std::size_t>(std::find_if(rivals.begin(), rivals.end(), is_wanted) -
                                    rivals.begin());
  };
  if (rivals.empty()) return 0;
  if (LightMoved(readings)) {
    const std::size_t swept =
        first([](const Rival& rival) { return rival.score.effect->where == Where::kSweep; });
    return swept < rivals.size() ? swept : 0;
  }
  std::size_t best = 0;
  if (IsGeneric(readings, *rivals.front().score.effect)) {
    const double enough = kAboutAsMuch * rivals.front().Charged();
    const std::size_t specific = first([&](const Rival& rival) {
      return !IsGeneric(readings, *rival.score.effect) && rival.Charged() > enough;
    });
    if (specific < rivals.size()) best = specific;
  }
  if (!rivals[best].score.effect->groups) return best;
  const double enough = kHardlyMore * rivals[best].Charged();
  for (std::size_t k = 0; k < rivals.size(); ++k) {
    const Effect& effect = *rivals[k].score.effect;
    if (!effect.groups || rivals[k].Charged() < enough) continue;
    if (Complexity(effect) < Complexity(*rivals[best].score.effect)) best = k;
  }
  return best;
}

}  // namespace lyrefit
