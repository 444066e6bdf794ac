#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "lyrefit/diagnose/decision_constants.h"
#include "lyrefit/diagnose/fit_effect.h"
#include "lyrefit/diagnose/selection_state.h"
#include "lyrefit/diagnose/values.h"

namespace lyrefit {
namespace {

bool IsSearched(const Effect& effect) {
  return std::any_of(effect.parameters.begin(), effect.parameters.end(),
                     [](const EffectParameter& parameter) { return parameter.searched; });
}

// An earlier fit with this effect beside the causes of the law, of the selection that is repeated or
// of the last step. Null if a parameter is selected on a grid, which must be repeated.
const LawFit* FindMet(const SelectionState& now, const Effect& effect) {
  if (IsSearched(effect)) return nullptr;
  std::vector<const Effect*> causes = now.fit.law.effects;
  causes.push_back(&effect);
  const auto* const repeated = now.fit.law.effects.empty() ? now.options.met : nullptr;
  for (const std::vector<FittedCandidate>* met : {repeated, &now.earlier}) {
    if (met == nullptr) continue;
    for (const FittedCandidate& one : *met) {
      if (one.fit.usable && one.fit.law.effects == causes) return &one.fit;
    }
  }
  return nullptr;
}

// A fit from the parameters of an earlier one; unusable if that has not this effect.
LawFit FitFromHint(const SelectionState& now, const Effect& effect) {
  const LawFit& found = now.options.hint;
  const Law& hint = found.law;
  const auto at = std::find(hint.effects.begin(), hint.effects.end(), &effect);
  if (!found.usable || at == hint.effects.end()) return {};
  const std::vector<double>& p = found.p;
  const auto own = p.begin() + hint.Offset(static_cast<int>(at - hint.effects.begin()));
  Law law = now.fit.law;
  law.effects.push_back(*at);
  law.freed = hint.freed;
  std::vector<double> start = now.fit.p;
  std::copy(p.begin(), p.begin() + law.base_size(), start.begin());
  start.insert(start.end(), own, own + (*at)->size());
  return FitLaw(now.weighted, law, start, UpTo(20, 1e-6));
}

LawFit FitCandidate(const SelectionState& now, const Score& score) {
  LawFit fit;
  if (const LawFit* met = FindMet(now, *score.effect)) fit = FitOnwards(now.weighted, *met);
  if (!fit.usable) {
    fit = FitEffect(now.weighted, now.fit, score,
                    now.options.repeats ? Effort::kInPassing : Effort::kFull);
  }
  LawFit hinted = FitFromHint(now, *score.effect);
  return hinted.usable && (!fit.usable || hinted.sum < fit.sum) ? hinted : fit;
}

bool HasSweepEffect(const Law& law) {
  return std::any_of(law.effects.begin(), law.effects.end(),
                     [](const Effect* effect) { return effect->where == Where::kSweep; });
}

// Whether a candidate describes the readings to within the floor, so that no elaborate one is
// needed.
bool IsDescribed(const WeightedData& weighted, const std::vector<FittedCandidate>& candidates,
                 double floor) {
  return std::any_of(candidates.begin(), candidates.end(), [&](const FittedCandidate& candidate) {
    return candidate.fit.law.effects.back()->where == Where::kDevice &&
           MissedBy(weighted, candidate.fit) < floor;
  });
}

// The most that a fit can be expected to gain decides whether it is tried.
struct Trying {
  double least_statistic = 0;
  bool by_shape = false;     // effects with starts from the curve's shape whatever their statistic
  bool only_sweeps = false;  // no effects but those of the sweep
  const Effect* best = nullptr;  // of the largest statistic
};

// Statistic of effect number `most` among those that can be fitted, best first. 0 if `most` is 0 or
// there are no more than that.
double LeastOfTheBest(const std::vector<Score>& scores, int most) {
  std::vector<double> statistics;
  for (const Score& score : scores) {
    if (score.testable && score.effect->probes != nullptr) statistics.push_back(score.statistic);
  }
  const auto count = static_cast<std::size_t>(most);
  if (most == 0 || statistics.size() <= count) return 0;
  std::sort(statistics.begin(), statistics.end(), std::greater<double>());
  return statistics[count - 1];
}

// The statistics of a ruined fit mislead, so that everything is then tried.
Trying TryingOf(const std::vector<Score>& scores, bool ruined, int most) {
  Trying trying;
  double best = 0;
  for (const Score& score : scores) {
    if (!score.testable || score.effect->probes == nullptr || score.statistic <= best) continue;
    best = score.statistic;
    trying.best = score.effect;
  }
  if (ruined) return trying;
  trying.least_statistic =
      std::max({kLeastStatistic, kHopelessPart * best, LeastOfTheBest(scores, most)});
  return trying;
}

// Whether `other` draws curves like those of an effect, so that both must be fitted to be told
// apart: a statistic is that of small sizes.
bool DrawsAlike(const Effect* effect, const Effect& other) {
  return effect != nullptr &&
         std::any_of(effect->confused_with.begin(), effect->confused_with.end(),
                     [&](const char* id) { return std::string_view(id) == other.id; });
}

bool IsTried(const Trying& trying, const Score& score) {
  const Effect& effect = *score.effect;
  if (effect.probes == nullptr) return false;
  if (trying.only_sweeps && effect.where != Where::kSweep) return false;
  if (trying.by_shape && effect.starts != nullptr) return true;
  return score.testable &&
         (score.statistic >= trying.least_statistic || DrawsAlike(trying.best, effect));
}

// Whether an effect of one sweep makes its plain RMSE larger than without it, which whitened
// residuals forgive: it would leave the curve to the rough path. Sweeps up and down are compared
// with each other, so that what both miss alike counts little.
bool LeavesToPath(const WeightedData& weighted, const LawFit& without, const LawFit& fit) {
  constexpr double kRounding = 1e-6;  // fits that end without the effect differ by it
  const DataTraits& traits = weighted.readings->traits;
  return traits.single && traits.turns.empty() &&
         RmseOf(weighted, fit.current) > (1 + kRounding) * RmseOf(weighted, without.current);
}

}  // namespace

Hypotheses FitCandidates(const SelectionState& now, const std::vector<Score>& scores) {
  Hypotheses hypotheses;
  hypotheses.none.fit = now.fit;
  const bool astray = !now.options.repeats && LeadsAstray(now.weighted, now.fit);
  const double floor = now.options.floors.current;
  Trying trying = TryingOf(scores, astray, now.options.most_fitted_candidates);
  trying.by_shape = now.measurement.readings.traits.single &&
                    ((floor > 0 && MissedBy(now.weighted, now.fit) > floor) || astray);
  trying.only_sweeps = LightMoved(now.measurement.readings) && !HasSweepEffect(now.fit.law);
  ReporterOf(now).Begin("selection", static_cast<std::int64_t>(scores.size()));
  const auto try_effects = [&](bool elaborate) {
    for (const Score& score : scores) {
      if (score.effect->elaborate != elaborate) continue;
      ReporterOf(now).Count();
      if (now.weighted.progress.Stopped()) break;
      if (!IsTried(trying, score)) continue;
      LawFit fit = FitCandidate(now, score);
      if (!fit.usable || LeavesToPath(now.weighted, now.fit, fit)) continue;
      hypotheses.candidates.push_back({score, std::move(fit)});
    }
  };
  try_effects(false);
  if (!IsDescribed(now.weighted, hypotheses.candidates, floor)) try_effects(true);
  Judge(now.weighted, now.base, now.options.judge, &hypotheses);
  return hypotheses;
}

const FittedCandidate* OwnCandidate(const ChosenCause& cause) {
  for (const FittedCandidate& candidate : cause.others.candidates) {
    if (candidate.score.effect == cause.effect) return &candidate;
  }
  return nullptr;
}

std::vector<const FittedCandidate*> EquivalentsOf(const ChosenCause& cause) {
  std::vector<const FittedCandidate*> equivalents;
  for (const FittedCandidate& candidate : cause.others.candidates) {
    const bool own = candidate.score.effect == cause.effect;
    if (!own && candidate.probability >= kNotable * cause.probability) {
      equivalents.push_back(&candidate);
    }
  }
  return equivalents;
}

namespace {

// The fit of an effect in the first step, with the base model alone. Null if there is none.
const FittedCandidate* TrialOf(const Hypotheses& first_step, const Effect* effect) {
  const std::vector<FittedCandidate>& trials = first_step.candidates;
  const auto at = std::find_if(trials.begin(), trials.end(), [&](const FittedCandidate& trial) {
    return trial.score.effect == effect && trial.fit.usable;
  });
  return at != trials.end() ? &*at : nullptr;
}

// Whether an effect was a notable alternative of the first step, to one of the causes.
bool WasNotable(const Selection& selection, const Effect* effect) {
  const FittedCandidate* trial = TrialOf(selection.trials, effect);
  const double best =
      selection.trials.candidates.empty() ? 0 : selection.trials.candidates.front().probability;
  return trial != nullptr && trial->probability >= kNotable * best;
}

// Fits an effect in a place. In the place of the only cause the fit of the first step goes on.
LawFit FitInPlace(const Selection& selection, const LawFit& without, const Score& score) {
  const FittedCandidate* trial = TrialOf(selection.trials, score.effect);
  if (trial != nullptr && without.law.effects.empty()) {
    LawFit fit = FitOnwards(selection.weighted, trial->fit);
    if (fit.usable) return fit;
  }
  return FitEffect(selection.weighted, without, score);
}

// The hypotheses in the place of cause number `c`.
Hypotheses FitPlace(const SelectOptions& options, int c, Selection* selection) {
  const WeightedData& weighted = selection->weighted;
  const Effect* own = selection->causes[c].effect;
  Hypotheses place;
  place.none.fit = FitWithout(weighted, selection->extended, c);
  const LawFit& without = place.none.fit;
  if (!without.usable || options.progress.Stopped()) return place;
  const std::vector<const Effect*> open = RoomFor(without.law, options.candidates);
  const std::vector<Score> scores = ScoreEffects(weighted, without, open, &selection->signatures);
  Trying trying = TryingOf(scores, false, 0);
  trying.by_shape = own->groups && weighted.readings->traits.single;
  trying.best = own;
  const bool described = !own->elaborate && options.floors.current > 0 &&
                         MissedBy(weighted, selection->extended) < options.floors.current;
  for (const Score& score : scores) {
    options.progress.Count();
    if (options.progress.Stopped()) break;
    const bool tried = IsTried(trying, score) && !(described && score.effect->elaborate);
    if (score.effect != own && !tried && !WasNotable(*selection, score.effect)) continue;
    LawFit fit = score.effect == own ? selection->extended : FitInPlace(*selection, without, score);
    if (!fit.usable || (score.effect != own && LeavesToPath(weighted, without, fit))) continue;
    place.candidates.push_back({score, std::move(fit)});
  }
  Judge(weighted, selection->base, options.judge, &place);
  return place;
}

// Puts another effect in the place of cause number `c`, or nothing.
void Replace(const Measurement& measurement, const FittedCandidate& better, int c,
             Selection* selection) {
  selection->causes.erase(selection->causes.begin() + c);
  if (better.score.effect != nullptr) {
    selection->causes.push_back({better.score.effect, better.score});
  }
  SettledFit settled = SettleNoise(measurement, std::move(selection->weighted), better.fit);
  selection->weighted = std::move(settled.weighted);
  selection->extended = std::move(settled.fit);
  selection->noise = std::move(settled.noise);
}

// What is clearly more probable in the place of an effect than the effect; null if nothing is.
// Findings are compared, and their most probable mechanisms taken.
const FittedCandidate* BetterThan(const Effect* own, const Hypotheses& place) {
  if (place.none.probability > 0.5) return &place.none;
  std::map<std::string, double> findings;
  const FittedCandidate* present = nullptr;
  for (const FittedCandidate& candidate : place.candidates) {
    findings[candidate.score.effect->Finding()] += candidate.probability;
    if (candidate.score.effect == own) present = &candidate;
  }
  if (present == nullptr) return nullptr;
  const auto weight = [&](const FittedCandidate& candidate) {
    return std::pair{findings[candidate.score.effect->Finding()], candidate.probability};
  };
  const FittedCandidate& best = *std::max_element(
      place.candidates.begin(), place.candidates.end(),
      [&](const FittedCandidate& a, const FittedCandidate& b) { return weight(a) < weight(b); });
  const auto [best_finding, best_own] = weight(best);
  const auto [own_finding, own_own] = weight(*present);
  const bool same = best.score.effect->Finding() == own->Finding();
  const double ratio = same ? best_own / own_own : best_finding / own_finding;
  return std::log(ratio) > kClearly ? &best : nullptr;
}

}  // namespace

void FindAlternatives(const Measurement& measurement, const SelectOptions& options,
                      Selection* selection) {
  int replacements = 0;
  options.progress.Begin("candidates", static_cast<std::int64_t>(options.candidates.size() *
                                                                 selection->causes.size()));
  for (std::size_t c = 0; c < selection->causes.size();) {
    if (selection->causes[c].in_values) {
      ++c;
      continue;
    }
    Hypotheses place = FitPlace(options, static_cast<int>(c), selection);
    if (options.progress.Stopped()) return;
    const FittedCandidate* better = BetterThan(selection->causes[c].effect, place);
    if (better != nullptr && replacements < kMostReplacements) {
      ++replacements;
      Replace(measurement, *better, static_cast<int>(c), selection);
      c = 0;
      continue;
    }
    ChosenCause& cause = selection->causes[c++];
    cause.others = std::move(place);
    if (const FittedCandidate* own = OwnCandidate(cause)) cause.probability = own->probability;
  }
}

}  // namespace lyrefit
