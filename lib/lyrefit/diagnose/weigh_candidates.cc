#include "lyrefit/diagnose/weigh_candidates.h"

#include <algorithm>

#include "lyrefit/diagnose/equivalents.h"
#include "lyrefit/diagnose/rank_causes.h"

namespace lyrefit {
namespace {

bool IsWorthAName(const WeightedData& weighted, const FittedCandidate& fitted,
                  const Without& without, const Weights& weights) {
  // Flexible effects need a larger part: they also fit the errors of the first cause's model.
  constexpr double kLaterPart = 0.02, kGenericPart = 0.2;
  const int last = static_cast<int>(fitted.fit.law.effects.size()) - 1;
  const EffectSize size = SizeOf(weighted, fitted.fit, last, without);
  if (!ExceedsFloors(size, weights.floors)) return false;
  const bool generic = IsGeneric(*weighted.readings, *fitted.score.effect);
  const double part = generic ? kGenericPart : kLaterPart;
  return weights.first_misfit == 0 || size.current * size.current > part * weights.first_misfit;
}

// If a preferred effect among those with cell groups is below the floors, the size of the cause is
// uncertain, and none is named.
void RankBelow(const WeightedData& weighted, double misfit, double floor,
               std::vector<FittedCandidate>* worthy, std::vector<FittedCandidate>* below) {
  if (worthy->empty() || below->empty()) return;
  std::vector<FittedCandidate> all = *worthy;
  all.insert(all.end(), below->begin(), below->end());
  PutBestFirst(&all);
  const Effect* best = all[RankCauses(weighted, all, misfit, floor)].score.effect;
  const bool is_below = std::any_of(below->begin(), below->end(), [&](const FittedCandidate& r) {
    return r.score.effect == best;
  });
  if (!is_below || !best->groups) return;
  *below = std::move(all);
  worthy->clear();
}

}  // namespace

double MissedBy(const WeightedData& weighted, const LawFit& fit) {
  std::vector<double> currents;
  for (const Reading& r : weighted.readings->points) currents.push_back(r.current);
  return LackOfFit(weighted, fit, currents);
}

std::vector<FittedCandidate> WeighCandidates(const WeightedData& weighted, const LawFit& fit,
                                             const std::vector<FittedCandidate>& all,
                                             const Weights& weights,
                                             std::vector<FittedCandidate>* below) {
  const double misfit = MissedBy(weighted, fit), floor = weights.floors.current;
  const Without without = MakeWithout(weighted, fit);
  std::vector<FittedCandidate> worthy;
  for (FittedCandidate fitted : all) {
    if (!HasPossibleSize(*weighted.readings, fit, fitted)) continue;
    fitted.left = MissedBy(weighted, fitted.fit);
    if (IsWorthAName(weighted, fitted, without, weights)) {
      worthy.push_back(std::move(fitted));
    } else if (fitted.corrected_p < weights.level) {
      below->push_back(std::move(fitted));
    }
  }
  // A flexible effect above the floors is rejected if an effect below them fits clearly better.
  const auto is_beaten = [&](const FittedCandidate& fitted) {
    if (!IsGeneric(*weighted.readings, *fitted.score.effect)) return false;
    return std::any_of(below->begin(), below->end(), [&](const FittedCandidate& other) {
      return other.Charged() > fitted.Charged() + kEquivalenceWidth;
    });
  };
  worthy.erase(std::remove_if(worthy.begin(), worthy.end(), is_beaten), worthy.end());
  RankBelow(weighted, misfit, floor, &worthy, below);
  for (std::vector<FittedCandidate>* fitted_candidates : {&worthy, below}) {
    const std::size_t at = RankCauses(weighted, *fitted_candidates, misfit, floor);
    const auto ranked_first = fitted_candidates->begin() + static_cast<std::ptrdiff_t>(at);
    if (!fitted_candidates->empty())
      std::rotate(fitted_candidates->begin(), ranked_first, ranked_first + 1);
  }
  return worthy;
}

}  // namespace lyrefit
