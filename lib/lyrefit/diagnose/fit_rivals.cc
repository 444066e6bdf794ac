#include <algorithm>
#include <utility>

#include "lyrefit/diagnose/fit_effect.h"
#include "lyrefit/diagnose/prefer.h"
#include "lyrefit/diagnose/selecting.h"
#include "lyrefit/diagnose/weigh_rivals.h"

namespace lyrefit {
namespace {

// The fit with one more effect of the selection that this one repeats. What is searched there is
// searched here as well.
const LawFit* FindMet(const Selecting& now, const Effect& effect) {
  const auto searched = [](const EffectParameter& parameter) { return parameter.searched; };
  const std::vector<Rival>* met = now.options.met;
  if (met == nullptr || !now.fit.law.effects.empty()) return nullptr;
  if (std::any_of(effect.parameters.begin(), effect.parameters.end(), searched)) return nullptr;
  const auto at = std::find_if(met->begin(), met->end(),
                               [&](const Rival& r) { return r.score.effect == &effect; });
  return at != met->end() && at->fit.usable ? &at->fit : nullptr;
}

// Once more from where the effect was found before.
void FitFromHint(const Selecting& now, const Effect& effect, LawFit* fit) {
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
  LawFit end = FitLaw(now.bench, law, start, UpTo(20, 1e-6));
  if (end.usable && (!fit->usable || end.sum < fit->sum)) *fit = std::move(end);
}

LawFit FitRival(const Selecting& now, const Score& score, bool briefly) {
  LawFit fit;
  if (const LawFit* met = FindMet(now, *score.effect)) fit = FitOnwards(now.bench, *met);
  if (!fit.usable) {
    const Effort effort = briefly                  ? Effort::kForTheRecord
                          : now.options.in_passing ? Effort::kInPassing
                                                   : Effort::kFull;
    fit = FitEffect(now.bench, now.fit, score, effort);
  }
  FitFromHint(now, *score.effect, &fit);
  return fit;
}

// What each takes off the sum of squares and what that is worth, in units of the smallest noise
// variance that any of them leaves.
void JudgeRivals(const Selecting& now, std::vector<Rival>* rivals) {
  double variance = NoiseVariance(now.bench, now.fit);
  for (const Rival& rival : *rivals) {
    variance = std::min(variance, NoiseVariance(now.bench, rival.fit));
  }
  for (Rival& rival : *rivals) {
    const Law& law = rival.fit.law;
    rival.statistic = (now.fit.sum - rival.fit.sum) / variance;
    rival.freedom = FreedomOf(now.bench, law);
    rival.corrected_p =
        CorrectedP(rival.score, rival.statistic, Degrees(now.bench, law), now.worth->calibration);
  }
  PutBestFirst(rivals);
}

}  // namespace

std::vector<Rival> FitRivals(const Selecting& now, const std::vector<Score>& scores, bool all,
                             bool is_there) {
  std::vector<Rival> rivals;
  const double floor = now.options.floors.current;
  const double hopeless =
      std::max(HopelessStatistic(scores), LeastOfTheBest(scores, now.options.most_rivals));
  // Nothing is worth a name that is smaller than what the present law misses.
  const bool may_matter = floor > 0 && MissedBy(now.bench, now.fit) > floor;
  const bool astray = may_matter || LeadsAstray(now.bench, now.fit);
  const bool single = now.measurement.readings.traits.single;
  Begin(Heard(now), "selection", static_cast<std::int64_t>(scores.size()));
  for (const Score& score : scores) {
    Step(Heard(now));
    // What the shape of the curve suggests does not hang on scores that a fault ruins.
    const bool by_shape = astray && is_there && score.effect->starts != nullptr && single;
    const bool fits = by_shape || (score.testable && (all || score.statistic >= hopeless) &&
                                   score.effect->probes != nullptr);
    if (!fits || Stopped(now.bench.watch)) continue;
    const bool briefly = !by_shape && (!is_there || score.statistic < hopeless);
    LawFit fit = FitRival(now, score, briefly);
    if (fit.usable) rivals.push_back({score, std::move(fit), 0});
  }
  JudgeRivals(now, &rivals);
  return rivals;
}

void FindRivals(const SelectOptions& options, Selection* selection) {
  const Workbench& bench = selection->bench;
  const LawFit& extended = selection->extended;
  for (std::size_t c = 0; c < selection->causes.size(); ++c) {
    ChosenCause& cause = selection->causes[c];
    Begin(options.watch, "rivals", static_cast<std::int64_t>(options.candidates.size()));
    selection->without.push_back(FitWithout(bench, extended, static_cast<int>(c)));
    const LawFit& without = selection->without.back();
    if (!without.usable || Stopped(options.watch) || cause.in_values) continue;
    std::vector<const Effect*> open = RoomFor(without.law, options.candidates);
    open.erase(std::remove_if(open.begin(), open.end(),
                              [](const Effect* effect) { return effect->probes == nullptr; }),
               open.end());
    const double variance = NoiseVariance(bench, extended);
    const std::vector<Score> scores =
        JudgeScores(PrepareAll(bench, without, open, &selection->imprints), *selection->worth);
    const double hopeless = HopelessStatistic(scores);
    for (const Score& score : scores) {
      Step(options.watch);
      if (!score.testable) continue;
      if (Stopped(options.watch)) break;
      const bool own = score.effect == cause.effect;
      if (score.statistic < hopeless && !own) continue;
      Rival rival{score, FitEffect(bench, without, score), 0};
      if (!rival.fit.usable) continue;
      const double sum = own ? std::min(rival.fit.sum, extended.sum) : rival.fit.sum;
      rival.statistic = (without.sum - sum) / variance;
      rival.freedom = FreedomOf(bench, rival.fit.law);
      const bool possible = own || HasPossibleSize(*bench.readings, without, rival);
      if (options.floors.Any() && !possible) continue;
      cause.rivals.push_back(std::move(rival));
    }
    PutBestFirst(&cause.rivals);
  }
}

}  // namespace lyrefit
