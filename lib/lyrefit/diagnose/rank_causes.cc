#include "lyrefit/diagnose/rank_causes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "lyrefit/model/curve_shape.h"

namespace lyrefit {
namespace {

double Value(const FittedCandidate& fitted, int parameter) {
  return fitted.fit.p[fitted.fit.p.size() - fitted.score.effect->parameters.size() + parameter];
}

bool IsCalled(const FittedCandidate& fitted, std::string_view id) {
  return fitted.score.effect->id == id;
}

bool IsWithoutShade(const FittedCandidate& fitted) {
  constexpr double kNothing = 1e-3;
  double deepest = 0;
  for (int k = 0; k + 1 < fitted.score.effect->size() - 2; k += 2) {
    if (Value(fitted, k + 1) > 0) deepest = std::max(deepest, Value(fitted, k));
  }
  return deepest < kNothing;
}

bool StrengthIsAtBound(const FittedCandidate& fitted) {
  constexpr double kSlack = 1e-3;
  const Effect& effect = *fitted.score.effect;
  if (effect.parameters.empty()) return false;
  // Any of the groups may be as bright as the brightest one.
  if (IsCalled(fitted, "substrings")) return IsWithoutShade(fitted);
  const EffectParameter& strength = effect.parameters.front();
  const double slack = kSlack * (strength.upper - strength.lower);
  return Value(fitted, 0) > strength.upper - slack ||
         Value(fitted, 0) < strength.lower + 1e-3 * slack;
}

// Number of cells that a shade covers in one substring.
double CoveredCells(const Readings& readings, double part) {
  return part * readings.traits.cells / std::max(SubstringsOf(readings.traits), 2);
}

// Rank of an effect that divides cells into groups, by the number of its assumptions. A shade on
// part of its substrings ranks above one that covers them. If it covers about one cell, it ranks
// last, since it is then a weak cell.
int Complexity(const WeightedData& weighted, const FittedCandidate& fitted) {
  constexpr double kOneCell = 1.6, kFewCells = 4, kFewMates = 2.5;
  constexpr std::array<std::string_view, 8> kInOrder = {"shading",    "leaky_cell", "mismatch",
                                                        "substrings", "scatter",    "partly",
                                                        "weak_cell",  "bypass_open"};
  const std::string_view id = fitted.score.effect->id;
  const auto place = [&](std::string_view one) {
    return static_cast<int>(std::find(kInOrder.begin(), kInOrder.end(), one) - kInOrder.begin());
  };
  // Several leaky cells need as many assumptions as one weak cell.
  if (id == "leaky_cell" && Value(fitted, 1) > kOneCell) return place("weak_cell");
  if (id == "mismatch" && Value(fitted, 1) * weighted.readings->traits.cells < kFewMates) {
    return static_cast<int>(kInOrder.size());
  }
  if (id != "shading" && id != "substrings") return place(id);
  const double covered = Value(fitted, fitted.score.effect->size() - 1);
  if (covered >= 1) return place(id);
  const double error = StandardErrors(Linearize(weighted, fitted.fit)).back() *
                       std::sqrt(NoiseVariance(weighted, fitted.fit));
  const auto cells = [&](double sigmas) {
    return CoveredCells(*weighted.readings, covered + sigmas * error);
  };
  const bool one = cells(-kNormal95) < kOneCell && cells(kNormal95) < kFewCells;
  return one ? static_cast<int>(kInOrder.size()) : place("partly");
}

bool HasPossibleIdeality(const LawFit& fit, double least) {
  constexpr double kMost = 2.5;
  const double n = Ideality(fit);
  return n > least && n < kMost;
}

// Whether a candidate leaves as small a lack of fit as another one, to within a fraction of the
// floor. Modules without a fault depart from any model by more than that fraction.
bool LeavesAsLittle(const FittedCandidate& fitted, const FittedCandidate& other, double floor,
                    double least_reached) {
  constexpr double kPart = 0.1;
  return fitted.Charged() >= least_reached * other.Charged() &&
         fitted.left <= other.left + kPart * floor;
}

}  // namespace

bool IsGeneric(const Readings& readings, const Effect& effect) {
  if (readings.traits.up_down) return effect.momentary;
  const std::string_view id = effect.id;
  return effect.where == Where::kSweep || id == "range_switch" || id == "clip";
}

bool LightMoved(const Readings& readings) {
  constexpr double kLeast = 0.01;
  if (!readings.traits.single || readings.traits.only_dark) return false;
  if (readings.traits.up_down) return false;  // stored charge has the same effect
  double lowest = 1e300, rise = 0;
  for (const double current : ShapeOf(readings).current) {
    lowest = std::min(lowest, current);
    rise = std::max(rise, current - lowest);
  }
  return rise > kLeast;
}

bool HasPossibleSize(const Readings& readings, const LawFit& before,
                     const FittedCandidate& fitted) {
  constexpr double kMostExponent = 4.99, kMostKelvin = 3, kLeastCell = 0.9, kLeastIdeality = 0.8,
                   kWholeLight = 0.999;
  const Effect& effect = *fitted.score.effect;
  const std::string_view id = effect.id;
  if (StrengthIsAtBound(fitted)) return false;
  if (id == "temp_drift" && std::fabs(Value(fitted, 0)) > kMostKelvin) return false;
  // At the largest exponent the shunt imitates the exponential of a diode.
  if (id == "nonohmic_shunt" && Value(fitted, 1) > kMostExponent) return false;
  if (id == "weak_cell" && Value(fitted, 0) * Value(fitted, effect.size() - 1) > kWholeLight) {
    return false;
  }
  if (id == "mismatch" && Value(fitted, 1) * readings.traits.cells < kLeastCell) return false;
  return HasPossibleIdeality(fitted.fit, kLeastIdeality) ||
         !HasPossibleIdeality(before, kLeastIdeality);
}

std::size_t RankCauses(const WeightedData& weighted,
                       const std::vector<FittedCandidate>& fitted_candidates, double misfit,
                       double floor) {
  const Readings& readings = *weighted.readings;
  constexpr double kAboutAsMuch = 0.9, kWithHysteresis = 0.75, kHardlyMore = 0.98,
                   kMuchSimpler = 0.88, kNotClearly = 0.6, kHalf = 0.5, kLeastIdeality = 0.9;
  constexpr int kComplex = 5;
  const auto first = [&](auto is_wanted) {
    return static_cast<std::size_t>(
        std::find_if(fitted_candidates.begin(), fitted_candidates.end(), is_wanted) -
        fitted_candidates.begin());
  };
  if (fitted_candidates.empty()) return 0;
  if (LightMoved(readings)) {
    const std::size_t swept = first(
        [](const FittedCandidate& fitted) { return fitted.score.effect->where == Where::kSweep; });
    return swept < fitted_candidates.size() ? swept : 0;
  }
  std::size_t best = 0;
  // Clouds are more frequent than range errors of this size. Two sweeps would separate the two
  // causes.
  if (IsCalled(fitted_candidates.front(), "range_switch") && !readings.traits.up_down) {
    const std::size_t step = first([&](const FittedCandidate& fitted) {
      return IsCalled(fitted, "irr_step") &&
             fitted.Charged() > kNotClearly * fitted_candidates.front().Charged();
    });
    if (step < fitted_candidates.size()) return step;
  }
  const auto bends = [&](const FittedCandidate& fitted) {
    return IsGeneric(readings, *fitted.score.effect) ||
           !HasPossibleIdeality(fitted.fit, kLeastIdeality);
  };
  if (bends(fitted_candidates.front())) {
    const double enough = (readings.traits.up_down ? kWithHysteresis : kAboutAsMuch) *
                          fitted_candidates.front().Charged();
    const std::size_t specific = first([&](const FittedCandidate& fitted) {
      if (bends(fitted)) return false;
      return fitted.Charged() > enough ||
             LeavesAsLittle(fitted, fitted_candidates.front(), floor, kHalf);
    });
    if (specific < fitted_candidates.size()) best = specific;
  }
  if (!fitted_candidates[best].score.effect->groups) return best;
  // A more complex cause is selected only if it explains more.
  const FittedCandidate& likeliest = fitted_candidates[best];
  const int most = Complexity(weighted, likeliest);
  for (std::size_t k = 0; k < fitted_candidates.size(); ++k) {
    if (!fitted_candidates[k].score.effect->groups) continue;
    const int complexity = Complexity(weighted, fitted_candidates[k]);
    const double part = most >= kComplex && complexity < kComplex ? kMuchSimpler : kHardlyMore;
    const double reached = fitted_candidates[k].Charged() / likeliest.Charged();
    const bool as_much = reached >= part && misfit * std::sqrt(std::max(1 - reached, 0.0)) <= floor;
    if (!as_much && !LeavesAsLittle(fitted_candidates[k], likeliest, floor, kAboutAsMuch)) continue;
    if (complexity < Complexity(weighted, fitted_candidates[best])) best = k;
  }
  return best;
}

}  // namespace lyrefit
