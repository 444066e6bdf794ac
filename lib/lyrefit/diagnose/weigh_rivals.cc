#include "lyrefit/diagnose/weigh_rivals.h"

#include <algorithm>

#include "lyrefit/diagnose/equivalents.h"
#include "lyrefit/diagnose/prefer.h"

namespace lyrefit {
namespace {

bool IsWorthAName(const Workbench& bench, const Rival& rival, const Without& without,
                  const Weights& weights) {
  // What bends to everything bends to what a cause's own model gets wrong.
  constexpr double kLaterPart = 0.02, kGenericPart = 0.2;
  const int last = static_cast<int>(rival.fit.law.effects.size()) - 1;
  const EffectSize size = SizeOf(bench, rival.fit, last, without);
  if (!IsMaterial(size, weights.floors)) return false;
  const bool generic = IsGeneric(*bench.readings, *rival.score.effect);
  const double part = generic ? kGenericPart : kLaterPart;
  return weights.first_misfit == 0 || size.current * size.current > part * weights.first_misfit;
}

// A size is not certain where unlike cells that explain as much are smaller: then nothing is worth
// a name.
void PreferBelow(const Workbench& bench, double misfit, double floor, std::vector<Rival>* worthy,
                 std::vector<Rival>* below) {
  if (worthy->empty() || below->empty()) return;
  std::vector<Rival> all = *worthy;
  all.insert(all.end(), below->begin(), below->end());
  PutBestFirst(&all);
  const Effect* best = all[Prefer(bench, all, misfit, floor)].score.effect;
  const bool is_below = std::any_of(below->begin(), below->end(),
                                    [&](const Rival& r) { return r.score.effect == best; });
  if (!is_below || !best->groups) return;
  *below = std::move(all);
  worthy->clear();
}

}  // namespace

double MissedBy(const Workbench& bench, const LawFit& fit) {
  std::vector<double> currents;
  for (const Reading& r : bench.readings->points) currents.push_back(r.current);
  return Departure(bench, fit, currents);
}

std::vector<Rival> WeighRivals(const Workbench& bench, const LawFit& fit,
                               const std::vector<Rival>& all, const Weights& weights,
                               std::vector<Rival>* below) {
  const double misfit = MissedBy(bench, fit), floor = weights.floors.current;
  const Without without = MakeWithout(bench, fit);
  std::vector<Rival> worthy;
  for (Rival rival : all) {
    if (!HasPossibleSize(*bench.readings, fit, rival)) continue;
    rival.left = MissedBy(bench, rival.fit);
    if (IsWorthAName(bench, rival, without, weights)) {
      worthy.push_back(std::move(rival));
    } else if (rival.corrected_p < weights.level) {
      below->push_back(std::move(rival));
    }
  }
  // What bends to everything is not larger for fitting worse than something small that is there.
  const auto is_beaten = [&](const Rival& rival) {
    if (!IsGeneric(*bench.readings, *rival.score.effect)) return false;
    return std::any_of(below->begin(), below->end(), [&](const Rival& other) {
      return other.Charged() > rival.Charged() + kEquivalenceWidth;
    });
  };
  worthy.erase(std::remove_if(worthy.begin(), worthy.end(), is_beaten), worthy.end());
  PreferBelow(bench, misfit, floor, &worthy, below);
  for (std::vector<Rival>* rivals : {&worthy, below}) {
    const std::size_t at = Prefer(bench, *rivals, misfit, floor);
    const auto preferred = rivals->begin() + static_cast<std::ptrdiff_t>(at);
    if (!rivals->empty()) std::rotate(rivals->begin(), preferred, preferred + 1);
  }
  return worthy;
}

}  // namespace lyrefit
