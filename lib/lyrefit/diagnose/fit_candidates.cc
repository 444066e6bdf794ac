#include <algorithm>
#include <utility>

#include "lyrefit/diagnose/fit_effect.h"
#include "lyrefit/diagnose/rank_causes.h"
#include "lyrefit/diagnose/selection_state.h"
#include "lyrefit/diagnose/weigh_candidates.h"

namespace lyrefit {
namespace {

// An earlier fit with this effect, of the selection that is repeated. Null if the law already has
// effects or if a parameter is selected on a grid, which must be repeated.
const LawFit* FindMet(const SelectionState& now, const Effect& effect) {
  const auto searched = [](const EffectParameter& parameter) { return parameter.searched; };
  const std::vector<FittedCandidate>* met = now.options.met;
  if (met == nullptr || !now.fit.law.effects.empty()) return nullptr;
  if (std::any_of(effect.parameters.begin(), effect.parameters.end(), searched)) return nullptr;
  const auto at = std::find_if(met->begin(), met->end(),
                               [&](const FittedCandidate& r) { return r.score.effect == &effect; });
  return at != met->end() && at->fit.usable ? &at->fit : nullptr;
}

// Fits once more from the parameters of an earlier fit; keeps the better result.
void FitFromHint(const SelectionState& now, const Effect& effect, LawFit* fit) {
  const LawFit& found = now.options.hint;
  const Law& hint = found.law;
  const auto at = std::find(hint.effects.begin(), hint.effects.end(), &effect);
  if (!found.usable || at == hint.effects.end()) return;
  const std::vector<double>& p = found.p;
  const auto own = p.begin() + hint.Offset(static_cast<int>(at - hint.effects.begin()));
  Law law = now.fit.law;
  law.effects.push_back(*at);
  law.freed = hint.freed;
  std::vector<double> start = now.fit.p;
  std::copy(p.begin(), p.begin() + law.base_size(), start.begin());
  start.insert(start.end(), own, own + (*at)->size());
  LawFit end = FitLaw(now.weighted, law, start, UpTo(20, 1e-6));
  if (end.usable && (!fit->usable || end.sum < fit->sum)) *fit = std::move(end);
}

LawFit FitCandidate(const SelectionState& now, const Score& score, bool briefly) {
  LawFit fit;
  if (const LawFit* met = FindMet(now, *score.effect)) fit = FitOnwards(now.weighted, *met);
  if (!fit.usable) {
    const Effort effort = briefly                  ? Effort::kForTheRecord
                          : now.options.in_passing ? Effort::kInPassing
                                                   : Effort::kFull;
    fit = FitEffect(now.weighted, now.fit, score, effort);
  }
  FitFromHint(now, *score.effect, &fit);
  return fit;
}

// Sets statistic, penalty and p-value of each candidate, in units of the smallest noise variance of
// all fits.
void JudgeCandidates(const SelectionState& now, std::vector<FittedCandidate>* fitted_candidates) {
  double variance = NoiseVariance(now.weighted, now.fit);
  for (const FittedCandidate& fitted : *fitted_candidates) {
    variance = std::min(variance, NoiseVariance(now.weighted, fitted.fit));
  }
  for (FittedCandidate& fitted : *fitted_candidates) {
    const Law& law = fitted.fit.law;
    fitted.statistic = (now.fit.sum - fitted.fit.sum) / variance;
    fitted.freedom = FreedomOf(now.weighted, law);
    fitted.corrected_p = CorrectedP(fitted.score, fitted.statistic, Degrees(now.weighted, law),
                                    now.calibration->calibration);
  }
  PutBestFirst(fitted_candidates);
}

}  // namespace

std::vector<FittedCandidate> FitCandidates(const SelectionState& now,
                                           const std::vector<Score>& scores, bool all,
                                           bool is_there) {
  std::vector<FittedCandidate> fitted_candidates;
  const double floor = now.options.floors.current;
  const double hopeless = std::max(HopelessStatistic(scores),
                                   LeastOfTheBest(scores, now.options.most_fitted_candidates));
  // No candidate can exceed the floor if the present lack of fit does not.
  const bool may_matter = floor > 0 && MissedBy(now.weighted, now.fit) > floor;
  const bool astray = may_matter || LeadsAstray(now.weighted, now.fit);
  const bool single = now.measurement.readings.traits.single;
  ReporterOf(now).Begin("selection", static_cast<std::int64_t>(scores.size()));
  for (const Score& score : scores) {
    ReporterOf(now).Count();
    // Effects with starts from the curve's shape are fitted even with low scores, since a fault can
    // spoil the scores.
    const bool by_shape = astray && is_there && score.effect->starts != nullptr && single;
    const bool fits = by_shape || (score.testable && (all || score.statistic >= hopeless) &&
                                   score.effect->probes != nullptr);
    if (!fits || now.weighted.progress.Stopped()) continue;
    const bool briefly = !by_shape && (!is_there || score.statistic < hopeless);
    LawFit fit = FitCandidate(now, score, briefly);
    if (fit.usable) fitted_candidates.push_back({score, std::move(fit), 0});
  }
  JudgeCandidates(now, &fitted_candidates);
  return fitted_candidates;
}

void FindFittedCandidates(const SelectOptions& options, Selection* selection) {
  const WeightedData& weighted = selection->weighted;
  const LawFit& extended = selection->extended;
  for (std::size_t c = 0; c < selection->causes.size(); ++c) {
    ChosenCause& cause = selection->causes[c];
    options.progress.Begin("candidates", static_cast<std::int64_t>(options.candidates.size()));
    selection->without.push_back(FitWithout(weighted, extended, static_cast<int>(c)));
    const LawFit& without = selection->without.back();
    if (!without.usable || options.progress.Stopped() || cause.in_values) continue;
    std::vector<const Effect*> open = RoomFor(without.law, options.candidates);
    open.erase(std::remove_if(open.begin(), open.end(),
                              [](const Effect* effect) { return effect->probes == nullptr; }),
               open.end());
    const double variance = NoiseVariance(weighted, extended);
    const std::vector<Score> scores = JudgeScores(
        PrepareAll(weighted, without, open, &selection->signatures), *selection->calibration);
    const double hopeless = HopelessStatistic(scores);
    for (const Score& score : scores) {
      options.progress.Count();
      if (!score.testable) continue;
      if (options.progress.Stopped()) break;
      const bool own = score.effect == cause.effect;
      if (score.statistic < hopeless && !own) continue;
      FittedCandidate fitted{score, FitEffect(weighted, without, score), 0};
      if (!fitted.fit.usable) continue;
      const double sum = own ? std::min(fitted.fit.sum, extended.sum) : fitted.fit.sum;
      fitted.statistic = (without.sum - sum) / variance;
      fitted.freedom = FreedomOf(weighted, fitted.fit.law);
      const bool possible = own || HasPossibleSize(*weighted.readings, without, fitted);
      if (options.floors.Any() && !possible) continue;
      cause.fitted_candidates.push_back(std::move(fitted));
    }
    PutBestFirst(&cause.fitted_candidates);
  }
}

}  // namespace lyrefit
