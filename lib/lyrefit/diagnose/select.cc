#include "lyrefit/diagnose/select.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "lyrefit/diagnose/decision_constants.h"
#include "lyrefit/diagnose/fit_effect.h"
#include "lyrefit/diagnose/law_coordinates.h"
#include "lyrefit/diagnose/selection_state.h"
#include "lyrefit/diagnose/verdict.h"
#include "lyrefit/effects/catalogue.h"

namespace lyrefit {
namespace {

SelectionState BeginSelection(const Measurement& measurement, const std::vector<char>& used,
                              double correlation, const SelectOptions& options) {
  SelectionState now{measurement, options, options.signatures, {}, {}, {}, {}, {}, {}};
  now.weighted.readings = std::make_shared<const Readings>(measurement.readings);
  now.weighted.sigma.assign(measurement.readings.points.size(), 1e-3);
  now.weighted.used = used;
  now.weighted.correlation = correlation;
  now.weighted.progress = options.progress;
  for (const int k : measurement.values.at_lower) now.weighted.used[k] = 0;
  for (const int k : measurement.values.at_voltage_limit) now.weighted.used[k] = 0;
  return now;
}

void FitBaseLaw(const Law& law, SelectionState* now) {
  const std::vector<double>& start = now->options.start;
  now->fit = start.empty() ? FitBase(now->weighted, law) : FitLaw(now->weighted, law, start);
}

// Fits the base model and its noise. False if there is no usable fit.
bool SettleBase(SelectionState* now) {
  ReporterOf(*now).Begin("base fit", 3);
  Law law = now->options.base;
  if (now->weighted.readings->points.size() <= kQuickToFit) now->weighted.progress = {};
  FitBaseLaw(law, now);
  now->weighted.progress = now->options.progress;
  now->base = now->fit;
  if (!now->fit.usable) return false;
  ReporterOf(*now).Count();
  SettleNoise(now);
  ReporterOf(*now).Count();
  if (now->options.start.empty()) law = ChooseLaw(now->weighted, law);
  FitBaseLaw(law, now);
  if (now->weighted.progress.Stopped()) now->fit = now->base;
  now->base = now->fit;
  return true;
}

// Adds the effect `clip` with the limits found in the values. Clipped readings are left out, since
// they only show that the instrument was at its limit.
void AddClip(SelectionState* now) {
  const ValueFindings& values = now->measurement.values;
  for (const int k : values.clipped) now->weighted.used[k] = 0;
  const Effect* clip = FindEffect("clip");
  Law law = now->fit.law;
  law.effects.push_back(clip);
  std::vector<double> start = now->fit.p;
  start.push_back(values.clip_level > 0 ? values.clip_level : kNoUpperLimit);
  start.push_back(values.limited ? values.lower_limit : kNoLowerLimit);
  now->fit = FitLaw(now->weighted, law, start);
  now->causes.push_back({clip, {}, true});
  SettleNoise(now);
}

// Frees the shape parameters of a momentary effect if the law is then more probable.
void FreeShape(const Effect& effect, SelectionState* now) {
  const LawFit& fit = now->fit;
  Law law = fit.law;
  for (int k = 0; k < effect.size(); ++k) {
    if (effect.parameters[k].fixed_by_default) law.freed.emplace_back(&effect, k);
  }
  if (law.freed.size() == fit.law.freed.size()) return;
  LawFit freed = FitLaw(now->weighted, law, fit.p);
  if (!freed.usable) return;
  const JudgeOptions& judge = now->options.judge;
  const double before = LogTotal(EvidenceOf(now->weighted, now->base, judge, fit));
  const double after = LogTotal(EvidenceOf(now->weighted, now->base, judge, freed));
  if (!(after > before)) return;
  now->fit = std::move(freed);
  SettleNoise(now);
}

void Accept(const FittedCandidate& candidate, SelectionState* now) {
  const Effect& effect = *candidate.score.effect;
  now->fit = candidate.fit;
  now->causes.push_back({&effect, candidate.score});
  SettleNoise(now);
  // A free shape bends to much, so that it belongs only to what is certain without it.
  if (effect.momentary && candidate.probability > now->options.probability) FreeShape(effect, now);
}

// The trials with the effects that were scored but not fitted.
std::vector<FittedCandidate> WithUntried(std::vector<FittedCandidate> trials,
                                         const std::vector<Score>& scores) {
  for (const Score& score : scores) {
    const bool there = std::any_of(trials.begin(), trials.end(), [&](const FittedCandidate& r) {
      return r.score.effect == score.effect;
    });
    if (!there) trials.push_back({score, {}, 0});
  }
  return trials;
}

// Size of the last effect of a candidate.
EffectSize SizeOfCandidate(const SelectionState& now, const FittedCandidate& candidate) {
  const int last = static_cast<int>(candidate.fit.law.effects.size()) - 1;
  return SizeOf(now.weighted, candidate.fit, last, MakeWithout(now.weighted, now.fit));
}

// Probability that no cause acts, or one below the floors.
double NothingMaterial(const Hypotheses& step) {
  double probability = step.none.probability;
  for (const FittedCandidate& candidate : step.candidates) {
    probability += (candidate.probability + candidate.as_slight) * (1 - candidate.material);
  }
  return std::min(probability, 1.0);  // a sum of shares may exceed one by rounding
}

// Least current by which one more cause must change a sweep. In one direction unlike cells or parts
// of cells and light that moves are described in part, in both a device that depends on its past,
// which settles in time as well: what is small beside them may be how they are in detail.
double LeastOfAnother(const SelectionState& now) {
  const DataTraits& traits = now.weighted.readings->traits;
  const bool both = !traits.turns.empty();
  const bool in_part =
      std::any_of(now.causes.begin(), now.causes.end(), [both](const ChosenCause& cause) {
        const Effect& effect = *cause.effect;
        return both ? effect.by_sweep
                    : effect.groups || effect.parts || effect.where == Where::kSweep;
      });
  if (!in_part || !traits.single) return 0;
  return kLeastPartOfAnother * LackOfFit(now.weighted, now.base, now.fit.current);
}

// Whether an effect below the floors is large enough to be mentioned.
bool IsWorthMention(const EffectSize& size, const Floors& floors) {
  return ExceedsFloors(size, {kMentionedPart * floors.current, kMentionedPart * floors.power});
}

// Drops the last causes, or all, if the law is more probable without them. Only now it counts that
// something unknown may act in their place.
void DropTheUnlikely(SelectionState* now) {
  const auto& judge = now->options.judge;
  const std::size_t first = now->causes.empty() || !now->causes.front().in_values ? 0 : 1;
  LawFit fit = now->fit, best = fit;
  std::size_t kept = now->causes.size();
  double highest = -HUGE_VAL;
  for (std::size_t count = now->causes.size();; --count) {
    double value = LogTotal(EvidenceOf(now->weighted, now->base, judge, fit));
    for (std::size_t c = first; c < count; ++c)
      value += LogPriorOdds(*now->causes[c].effect, judge);
    if (value > highest) {
      highest = value;
      best = fit;
      kept = count;
    }
    if (count <= first || now->weighted.progress.Stopped()) break;
    fit = FitWithout(now->weighted, fit, static_cast<int>(count) - 1);
    if (!fit.usable) break;
  }
  if (kept == now->causes.size()) return;
  now->fit = std::move(best);
  now->causes.resize(kept);
  SettleNoise(now);
}

// Leaves out wrong readings, one by one, without new fits of the candidates: causes gain little when
// one reading is left out.
bool LeaveOutWrong(std::vector<Score> scores, const Hypotheses& step, SelectionState* now) {
  const Score* single = FindScore(scores, FoundBy::kSingleReading);
  if (single == nullptr) return false;
  const Effect* effect = single->effect;
  bool any = false;
  while (auto left_out =
             FindFurthest(now->weighted, now->fit, scores, step, now->wrong.readings.size())) {
    any = true;
    now->weighted.used[left_out->reading] = 0;
    (left_out->at_rest ? now->wrong.at_rest : now->wrong.readings).push_back(left_out->reading);
    now->fit = std::move(left_out->fit);
    scores = ScoreEffects(now->weighted, now->fit, {effect}, &now->signatures);
  }
  if (any) SettleNoise(now);
  return any;
}

// Uses left-out readings again that the present fit explains, and repeats the fit.
void Readmit(SelectionState* now) {
  std::vector<int> still_wrong;
  for (const int k : now->wrong.readings) {
    const bool explained = Explains(now->weighted, now->fit, k);
    if (explained) now->weighted.used[k] = 1;
    if (!explained) still_wrong.push_back(k);
  }
  if (still_wrong.size() == now->wrong.readings.size()) return;
  now->wrong.readings = std::move(still_wrong);
  LawFit again = FitLaw(now->weighted, now->fit.law, now->fit.p);
  if (again.usable) now->fit = std::move(again);
  SettleNoise(now);
}

// The first or the last `count` used readings of the stretch of which reading k is an end; empty if k
// is none.
std::vector<int> EndAt(const WeightedData& weighted, int k, int count, int inwards) {
  const std::vector<Reading>& points = weighted.readings->points;
  const auto within = [&](int i) {
    return i >= 0 && i < static_cast<int>(points.size()) && points[i].segment == points[k].segment;
  };
  std::vector<int> end;
  if (within(k - inwards)) return end;
  for (int i = k; within(i) && static_cast<int>(end.size()) < count; i += inwards) {
    if (weighted.used[i] != 0) end.push_back(i);
  }
  return end;
}

// Whether these readings are the one at open circuit, the highest voltage of all.
bool IsVocAlone(const WeightedData& weighted, const std::vector<int>& end) {
  const std::vector<Reading>& points = weighted.readings->points;
  const auto higher = [&](const Reading& reading) {
    return reading.voltage > points[end.front()].voltage && !reading.suns_voc;
  };
  return end.size() == 1 && std::none_of(points.begin(), points.end(), higher);
}

// Leaves out the first or the last readings of a stretch if the most probable cause shows in them
// alone: the base law describes the others, and no cause is as probable for them. By hand, Isc and
// Voc are often taken apart from the others, in flashers Voc in a flash of its own, and at the end of
// a sweep instruments slip. The reading of Voc alone makes no cause where a possible junction describes
// the others, whatever part of the misfit it is. Of a sweep up and down, the other direction tells
// what the device does there.
bool LeaveOutEnd(const FittedCandidate& best, SelectionState* now) {
  const DataTraits& traits = now->weighted.readings->traits;
  if (!now->fit.law.effects.empty() || !traits.single || !traits.turns.empty()) return false;
  constexpr int kMost = 3;
  constexpr double kPartLeft = 0.5;  // of the misfit, noise included
  const JudgeOptions& judge = now->options.judge;
  const int points = static_cast<int>(now->weighted.used.size());
  const int left_out = static_cast<int>(now->wrong.readings.size());
  const int most = std::min(kMost, std::max(1, static_cast<int>(kMostWrong * points)) - left_out);
  for (int count = 1; count <= most; ++count) {
    for (int place = 0; place < 2 * points; ++place) {
      const std::vector<int> end = EndAt(now->weighted, place / 2, count, place % 2 == 0 ? 1 : -1);
      if (end.empty()) continue;
      WeightedData others = now->weighted;
      for (const int k : end) others.used[k] = 0;
      LawFit none = FitBase(others, now->fit.law);
      if (others.progress.Stopped()) return false;
      const bool described =
          none.usable && LeftBy(others, none).value < now->options.floors.current &&
          ((IsVocAlone(now->weighted, end) && !LeadsAstray(others, none)) ||
           MissedBy(others, none) < kPartLeft * MissedBy(now->weighted, now->fit));
      if (!described) continue;
      const LawFit with = FitLaw(others, best.fit.law, best.fit.p);
      const double alone = LogTotal(EvidenceOf(others, none, judge, none));
      const double caused =
          LogTotal(EvidenceOf(others, none, judge, with)) + LogPriorOdds(*best.score.effect, judge);
      if (!with.usable || alone < caused) continue;
      now->weighted = std::move(others);
      now->fit = std::move(none);
      now->wrong.readings.insert(now->wrong.readings.end(), end.begin(), end.end());
      SettleNoise(now);
      return true;
    }
  }
  return false;
}

void Extend(SelectionState* now) {
  const int most = now->options.largest_causes + static_cast<int>(now->causes.size());
  const double least = std::log(now->options.probability / (1 - now->options.probability));
  std::set<std::set<const Effect*>> seen;
  for (bool first = true;; first = false) {
    const std::vector<Score> scores = ScoreOpen(now);
    if (now->weighted.progress.Stopped()) return;
    const Floors& floors = now->options.floors;
    if (floors.Any() && MissedBy(now->weighted, now->fit) < LeastOfAnother(*now)) {
      if (LeaveOutWrong(scores, {}, now)) continue;
      return;  // no cause that is left can be large enough
    }
    Hypotheses step = FitCandidates(*now, scores);
    if (first) {
      for (FittedCandidate& candidate : step.candidates) {
        candidate.material =
            ProbabilityAbove(SizeOfCandidate(*now, candidate), now->options.floors);
      }
      now->trials = step;
      now->none = NothingMaterial(step);
      now->trials.candidates = WithUntried(std::move(now->trials.candidates), scores);
    }
    if (now->weighted.progress.Stopped()) return;
    if (LeaveOutWrong(scores, step, now)) {
      if (!now->options.thorough && !now->options.repeats)
        now->earlier = std::move(step.candidates);
      continue;
    }
    now->earlier.clear();
    if (step.candidates.empty() || static_cast<int>(now->causes.size()) >= most) return;
    const FittedCandidate& best = *MostProbable(step.candidates);
    if (!(best.LogComplete() > step.none.LogComplete() + least)) return;
    const EffectSize size = SizeOfCandidate(*now, best);
    if (floors.Any() && !ExceedsFloors(size, floors)) {
      if (IsWorthMention(size, floors)) now->below = std::move(step);
      return;
    }
    if (floors.Any() && size.current < LeastOfAnother(*now)) return;
    if (LeaveOutEnd(best, now)) continue;
    Accept(best, now);
    SwapCauses(now);
    Readmit(now);
    const std::vector<const Effect*>& effects = now->fit.law.effects;
    const std::set<const Effect*> present(effects.begin(), effects.end());
    if (!seen.insert(present).second) return;  // a set of causes recurred: stop
  }
}

}  // namespace

std::vector<Score> ScoreOpen(SelectionState* now) {
  const std::vector<const Effect*> open = RoomFor(now->fit.law, now->options.candidates);
  return ScoreEffects(now->weighted, now->fit, open, &now->signatures);
}

Selection SelectCauses(const Measurement& measurement, const std::vector<char>& used,
                       double correlation, const SelectOptions& options) {
  SelectionState now = BeginSelection(measurement, used, correlation, options);
  Selection selection;
  const bool usable = SettleBase(&now);
  selection.base = selection.extended = now.base;
  selection.weighted = selection.base_weighted = now.weighted;
  if (!usable) return selection;
  if (measurement.values.HasLimits()) AddClip(&now);
  Extend(&now);
  DropTheUnlikely(&now);
  selection.incomplete =
      IncompleteProbability(EvidenceOf(now.weighted, now.base, options.judge, now.fit));
  selection.extended = std::move(now.fit);
  selection.causes = std::move(now.causes);
  selection.outliers = std::move(now.wrong.readings);
  selection.at_rest = std::move(now.wrong.at_rest);
  selection.weighted = std::move(now.weighted);
  selection.noise = std::move(now.noise);
  selection.signatures = std::move(now.signatures);
  selection.trials = std::move(now.trials);
  selection.below = std::move(now.below);
  selection.none = now.none;
  return selection;
}

}  // namespace lyrefit
