#include <algorithm>
#include <utility>

#include "lyrefit/diagnose/fit_effect.h"
#include "lyrefit/diagnose/selection_state.h"

namespace lyrefit {
namespace {

// Adds the best effect to the fit, from which `cause` was already removed, if it fits better than
// `cause` did. `present`: the fit with `cause`.
bool PutBetter(const ChosenCause& cause, const LawFit& present, SelectionState* now) {
  std::vector<FittedCandidate> fitted_candidates =
      FitCandidates(*now, JudgeScores(PrepareOpen(now), *now->calibration));
  const auto own =
      std::find_if(fitted_candidates.begin(), fitted_candidates.end(),
                   [&](const FittedCandidate& r) { return r.score.effect == cause.effect; });
  const double kept = own == fitted_candidates.end()
                          ? 0
                          : own->Charged() + std::max(0.0, own->fit.sum - present.sum) /
                                                 NoiseVariance(now->weighted, present);
  const bool stopped = now->weighted.progress.Stopped();
  std::vector<FittedCandidate> below;
  if (now->options.floors.Any()) fitted_candidates = Weigh(*now, fitted_candidates, &below);
  if (stopped || fitted_candidates.empty()) return false;
  const FittedCandidate& best = fitted_candidates.front();
  if (best.score.effect == cause.effect || !(best.Charged() > kept + 1)) return false;
  now->fit = best.fit;
  now->causes.push_back({best.score.effect, cause.corrected_p, best.score, {}});
  SettleNoise(now);
  return true;
}

bool SwapOne(int c, SelectionState* now) {
  const LawFit present = now->fit;
  const std::vector<ChosenCause> chosen = now->causes;
  now->fit = FitWithout(now->weighted, present, c);
  now->causes.erase(now->causes.begin() + c);
  if (now->fit.usable && PutBetter(chosen[c], present, now)) return true;
  now->fit = present;
  now->causes = chosen;
  return false;
}

}  // namespace

void SwapCauses(SelectionState* now) {
  if (now->options.in_passing) return;
  for (int round = 0; round < 2; ++round) {
    bool changed = false;
    for (int c = 0; c + 1 < static_cast<int>(now->causes.size()); ++c) {
      if (now->causes[c].in_values) continue;
      if (now->weighted.progress.Stopped()) return;
      changed = SwapOne(c, now) || changed;
    }
    if (!changed) return;
  }
}

void Prune(SelectionState* now) {
  const LawFit& fit = now->fit;
  for (int c = static_cast<int>(now->causes.size()) - 1; c >= 0 && now->causes.size() > 1; --c) {
    const ChosenCause& cause = now->causes[c];
    if (cause.in_values) continue;
    LawFit without = FitWithout(now->weighted, fit, c);
    if (!without.usable || now->weighted.progress.Stopped()) continue;
    const double loss = (without.sum - fit.sum) / NoiseVariance(now->weighted, fit);
    const double p = CorrectedP(cause.score, loss, Degrees(now->weighted, fit.law),
                                now->calibration->calibration);
    if (p < now->options.level * kLaterLevel) continue;
    now->fit = std::move(without);
    now->causes.erase(now->causes.begin() + c);
    SettleNoise(now);
  }
}

}  // namespace lyrefit
