#include <algorithm>
#include <utility>

#include "lyrefit/diagnose/decision_constants.h"
#include "lyrefit/diagnose/fit_effect.h"
#include "lyrefit/diagnose/selection_state.h"

namespace lyrefit {
namespace {

// Puts the best hypothesis in the place of cause number `c`. False if the cause itself is the best.
bool SwapOne(int c, SelectionState* now) {
  const LawFit present = now->fit;
  const std::vector<ChosenCause> chosen = now->causes;
  const auto keep = [&] {
    now->fit = present;
    now->causes = chosen;
    return false;
  };
  now->fit = FitWithout(now->weighted, present, c);
  now->causes.erase(now->causes.begin() + c);
  if (!now->fit.usable) return keep();
  const JudgeOptions& judge = now->options.judge;
  const double kept = EvidenceOf(now->weighted, now->base, judge, present).complete +
                      LogPriorOdds(*chosen[c].effect, judge);
  const Hypotheses place = FitCandidates(*now, ScoreOpen(now));
  if (now->weighted.progress.Stopped()) return keep();
  const double none = place.none.LogComplete();
  const auto best = MostProbable(place.candidates);
  const bool replaced = best != place.candidates.end() && best->score.effect != chosen[c].effect &&
                        best->LogComplete() > std::max(kept, none) + kClearly;
  if (!replaced && none < kept) return keep();
  if (replaced) {
    now->fit = best->fit;
    now->causes.push_back({best->score.effect, best->score});
  }
  SettleNoise(now);
  return true;
}

}  // namespace

void SwapCauses(SelectionState* now) {
  if (now->options.repeats) return;
  constexpr int kRounds = 2;
  for (int round = 0; round < kRounds; ++round) {
    bool changed = false;
    for (int c = 0; c + 1 < static_cast<int>(now->causes.size()); ++c) {
      if (now->causes[c].in_values) continue;
      if (now->weighted.progress.Stopped()) return;
      changed = SwapOne(c, now) || changed;
    }
    if (!changed) return;
  }
}

}  // namespace lyrefit
