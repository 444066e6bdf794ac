#include <algorithm>
#include <utility>

#include "lyrefit/diagnose/fit_effect.h"
#include "lyrefit/diagnose/selecting.h"

namespace lyrefit {
namespace {

// Puts the best effect into the place of cause `c`, which the fit is already without, where it does
// better there than the cause did.
bool PutBetter(const ChosenCause& cause, const LawFit& present, Selecting* now) {
  std::vector<Rival> rivals = FitRivals(*now, JudgeScores(PrepareOpen(now), *now->worth));
  const auto own = std::find_if(rivals.begin(), rivals.end(),
                                [&](const Rival& r) { return r.score.effect == cause.effect; });
  const double kept = own == rivals.end()
                          ? 0
                          : own->Charged() + std::max(0.0, own->fit.sum - present.sum) /
                                                 NoiseVariance(now->bench, present);
  const bool stopped = Stopped(now->bench.watch);
  std::vector<Rival> below;
  if (now->options.floors.Any()) rivals = Weigh(*now, rivals, &below);
  if (stopped || rivals.empty()) return false;
  const Rival& best = rivals.front();
  if (best.score.effect == cause.effect || !(best.Charged() > kept + 1)) return false;
  now->fit = best.fit;
  now->causes.push_back({best.score.effect, cause.corrected_p, best.score, {}});
  SettleNoise(now);
  return true;
}

bool ExchangeOne(int c, Selecting* now) {
  const LawFit present = now->fit;
  const std::vector<ChosenCause> chosen = now->causes;
  now->fit = FitWithout(now->bench, present, c);
  now->causes.erase(now->causes.begin() + c);
  if (now->fit.usable && PutBetter(chosen[c], present, now)) return true;
  now->fit = present;
  now->causes = chosen;
  return false;
}

}  // namespace

void Exchange(Selecting* now) {
  if (now->options.in_passing) return;
  for (int round = 0; round < 2; ++round) {
    bool changed = false;
    for (int c = 0; c + 1 < static_cast<int>(now->causes.size()); ++c) {
      if (now->causes[c].in_values) continue;
      if (Stopped(now->bench.watch)) return;
      changed = ExchangeOne(c, now) || changed;
    }
    if (!changed) return;
  }
}

void Prune(Selecting* now) {
  const LawFit& fit = now->fit;
  for (int c = static_cast<int>(now->causes.size()) - 1; c >= 0 && now->causes.size() > 1; --c) {
    const ChosenCause& cause = now->causes[c];
    if (cause.in_values) continue;
    LawFit without = FitWithout(now->bench, fit, c);
    if (!without.usable || Stopped(now->bench.watch)) continue;
    const double loss = (without.sum - fit.sum) / NoiseVariance(now->bench, fit);
    const double p =
        CorrectedP(cause.score, loss, Degrees(now->bench, fit.law), now->worth->calibration);
    if (p < now->options.level * kLaterLevel) continue;
    now->fit = std::move(without);
    now->causes.erase(now->causes.begin() + c);
    SettleNoise(now);
  }
}

}  // namespace lyrefit
