#include "lyrefit/diagnose/select.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "lyrefit/diagnose/choose_base.h"
#include "lyrefit/diagnose/fit_effect.h"
#include "lyrefit/diagnose/prefer.h"
#include "lyrefit/diagnose/selecting.h"
#include "lyrefit/diagnose/weigh_rivals.h"
#include "lyrefit/effects/catalogue.h"

namespace lyrefit {
namespace {

Selecting BeginSelecting(const Measurement& measurement, const std::vector<char>& used,
                         double correlation, const SelectOptions& options) {
  Selecting now{measurement, options, options.worth, options.imprints, {}, {}, {}, {}, {}};
  now.bench.readings = std::make_shared<const Readings>(measurement.readings);
  now.bench.sigma.assign(measurement.readings.points.size(), 1e-3);
  now.bench.used = used;
  now.bench.correlation = correlation;
  now.bench.watch = options.watch;
  for (const int k : measurement.values.at_lower) now.bench.used[k] = 0;
  for (const int k : measurement.values.at_voltage_limit) now.bench.used[k] = 0;
  return now;
}

void FitBaseLaw(const Law& law, Selecting* now) {
  const std::vector<double>& start = now->options.start;
  now->fit = start.empty() ? FitBase(now->bench, law) : FitLaw(now->bench, law, start);
}

// The base model and its noise. False where it cannot be had.
bool SettleBase(Selecting* now, Selection* selection) {
  Begin(Heard(*now), "base fit", 3);
  Law law = now->options.base;
  if (now->bench.readings->points.size() <= kQuickToFit) now->bench.watch = nullptr;
  FitBaseLaw(law, now);
  now->bench.watch = now->options.watch;
  selection->base = selection->extended = now->fit;
  selection->bench = selection->base_bench = now->bench;
  if (!now->fit.usable) return false;
  Step(Heard(*now));
  SettleNoise(now);
  Step(Heard(*now));
  if (now->options.start.empty()) law = ChooseLaw(now->bench, law);
  FitBaseLaw(law, now);
  if (Stopped(now->bench.watch)) now->fit = selection->base;
  selection->base = now->fit;
  selection->base_bench = now->bench;
  return true;
}

// Clipped readings say no more than that they were clipped: they are left out, and the limit
// stays what the values show.
void AddClip(Selecting* now) {
  const ValueFindings& values = now->measurement.values;
  for (const int k : values.clipped) now->bench.used[k] = 0;
  const Effect* clip = FindEffect("clip");
  Law law = now->fit.law;
  law.effects.push_back(clip);
  std::vector<double> start = now->fit.p;
  start.push_back(values.clip_level > 0 ? values.clip_level : kNoUpperLimit);
  start.push_back(values.limited ? values.lower_limit : kNoLowerLimit);
  now->fit = FitLaw(now->bench, law, start);
  now->causes.push_back({clip, 0, {}, {}, true});
  SettleNoise(now);
}

void FindWorth(const Prepared& prepared, Selecting* now) {
  if (now->worth != nullptr) return;
  const bool voltage = now->noise.lit.voltage > 0 || now->noise.dark.voltage > 0;
  const NoiseEstimator noise(now->measurement, now->bench.used,
                             voltage ? VoltageNoise::kAlways : VoltageNoise::kNever);
  now->worth = std::make_shared<const ScoreWorth>(
      SimulateWorth(now->bench, prepared, &noise, now->options.draws, now->options.seed));
}

// Without floors a later cause explains its part in units of the noise: what remains of a first
// cause whose own model is a little wrong is no second cause.
bool ExplainsEnough(const Selecting& now, const Rival& rival) {
  constexpr double kLaterPart = 0.02, kGenericPart = 0.05;
  const bool generic = IsGeneric(*now.bench.readings, *rival.score.effect);
  return rival.statistic >= (generic ? kGenericPart : kLaterPart) * now.first_gain;
}

// Whether the base model is so far off that scores beside it say nothing.
bool IsRuined(const Selecting& now) {
  constexpr double kMisfit = 0.01;
  if (!now.measurement.has_path()) return false;
  return MissedBy(now.bench, now.fit) > kMisfit;
}

// Whether any score passes the level of this step.
bool IsAnythingThere(const std::vector<Score>& scores, int step, Selecting* now) {
  double smallest = 1;
  for (const Score& score : scores) {
    if (score.testable) smallest = std::min(smallest, score.corrected_p);
  }
  const bool later = !now->causes.empty() || !now->wrong.readings.empty();
  now->level = now->options.level * (later ? kLaterLevel : 1);
  return smallest < now->level || (step == 0 && IsRuined(*now));
}

double UnknownP(const std::vector<Score>& scores) {
  const Score* unknown = FindScore(scores, FoundBy::kWaves);
  return unknown != nullptr && unknown->testable ? unknown->corrected_p : 1;
}

// Effects that were scored but have nothing to fit are trials as well.
void AddUntried(const std::vector<Score>& scores, std::vector<Rival>* trials) {
  for (const Score& score : scores) {
    const bool there = std::any_of(trials->begin(), trials->end(),
                                   [&](const Rival& r) { return r.score.effect == score.effect; });
    if (!there) trials->push_back({score, {}, 0});
  }
}

bool LeaveOut(const std::vector<Score>& scores, const std::vector<Rival>& rivals, Selecting* now) {
  const bool left_out =
      LeaveOutFurthest(scores, rivals, now->level, &now->bench, &now->fit, &now->wrong);
  if (left_out) SettleNoise(now);
  return left_out;
}

// Leaves those of the rivals that are worth a name. False where there are some and none is.
bool KeepWorthy(Selecting* now, Selection* selection, std::vector<Rival>* rivals) {
  const bool first = now->causes.empty();
  if (now->options.floors.Any()) {
    selection->below.clear();
    *rivals = Weigh(*now, *rivals, &selection->below);
    if (rivals->empty()) return false;
    if (first) {
      const double taken = Departure(now->bench, now->fit, rivals->front().fit.current);
      now->first_misfit = std::pow(taken, 2);
    }
    return true;
  }
  if (rivals->empty()) return true;
  if (first) now->first_gain = rivals->front().statistic;
  return ExplainsEnough(*now, rivals->front());
}

// A moment of the light that is there has the shape that it has, where that is worth its freedom.
void FreeShape(const Effect& effect, Selecting* now) {
  const LawFit& fit = now->fit;
  Law law = fit.law;
  for (int k = 0; k < effect.size(); ++k) {
    if (effect.parameters[k].held) law.freed.emplace_back(&effect, k);
  }
  if (law.freed.size() == fit.law.freed.size()) return;
  LawFit freed = FitLaw(now->bench, law, fit.p);
  const double paid = FreedomOf(now->bench, law) - FreedomOf(now->bench, fit.law);
  if (!freed.usable) return;
  if (!(freed.sum + paid * NoiseVariance(now->bench, freed) < fit.sum)) return;
  now->fit = std::move(freed);
  SettleNoise(now);
}

bool Accept(const Rival& rival, Selecting* now) {
  const Effect& effect = *rival.score.effect;
  const bool floors = now->options.floors.Any();
  double p = rival.corrected_p;
  const bool proven = floors && now->causes.empty() && effect.where == Where::kSweep &&
                      LightMoved(*now->bench.readings);
  if (proven) p = 0;
  if (!(p < now->level)) return false;
  now->fit = rival.fit;
  now->causes.push_back({&effect, p, rival.score, {}});
  SettleNoise(now);
  if (floors && effect.momentary) FreeShape(effect, now);
  return true;
}

void Extend(Prepared prepared, Selecting* now, Selection* selection) {
  const SelectOptions& options = now->options;
  const int most = options.largest_causes + static_cast<int>(now->causes.size());
  std::set<std::set<const Effect*>> seen;
  std::vector<Rival> rivals;  // of the step before where that took a single reading
  for (int step = 0;; ++step) {
    if (step > 0) prepared = PrepareOpen(now);
    const std::vector<Score> scores = JudgeScores(prepared, *now->worth);
    if (Stopped(now->bench.watch)) return;
    selection->unknown_p = UnknownP(scores);
    const bool is_there = IsAnythingThere(scores, step, now);
    if (step == 0 && options.trials) {
      selection->trials = rivals = FitRivals(*now, scores, true, is_there);
      AddUntried(scores, &selection->trials);
    }
    if (!is_there) return;
    if (static_cast<int>(now->causes.size()) >= most) return;
    // Causes gain little from a reading less: no new fits where the next stands out by far.
    const bool left = step > 0 && !rivals.empty();
    if (left && StandsOut(scores) && LeaveOut(scores, rivals, now)) continue;
    if (step > 0 || !options.trials) rivals = FitRivals(*now, scores);
    if (Stopped(now->bench.watch)) return;
    if (LeaveOut(scores, rivals, now)) continue;
    if (!KeepWorthy(now, selection, &rivals)) return;
    if (rivals.empty() || !Accept(rivals.front(), now)) {
      selection->unknown =
          now->causes.empty() && now->wrong.readings.empty() && selection->unknown_p < now->level;
      return;
    }
    selection->below.clear();  // beside a model that is the past
    Exchange(now);
    Prune(now);
    if (Readmit(&now->bench, &now->fit, &now->wrong)) SettleNoise(now);
    const std::vector<const Effect*>& effects = now->fit.law.effects;
    const std::set<const Effect*> present(effects.begin(), effects.end());
    if (!seen.insert(present).second) return;  // what was dropped came back
    rivals.clear();
  }
}

}  // namespace

Prepared PrepareOpen(Selecting* now) {
  const std::vector<const Effect*> open = RoomFor(now->fit.law, now->options.candidates);
  return PrepareAll(now->bench, now->fit, open, &now->imprints);
}

std::vector<Rival> Weigh(const Selecting& now, const std::vector<Rival>& all,
                         std::vector<Rival>* below) {
  const Weights weights{now.options.floors, now.level, now.first_misfit};
  return WeighRivals(now.bench, now.fit, all, weights, below);
}

Selection SelectCauses(const Measurement& measurement, const std::vector<char>& used,
                       double correlation, const SelectOptions& options) {
  Selecting now = BeginSelecting(measurement, used, correlation, options);
  Selection selection;
  if (!SettleBase(&now, &selection)) return selection;
  if (measurement.values.HasLimits()) AddClip(&now);
  Prepared prepared = PrepareOpen(&now);
  FindWorth(prepared, &now);
  Extend(std::move(prepared), &now, &selection);
  selection.extended = std::move(now.fit);
  selection.causes = std::move(now.causes);
  selection.outliers = std::move(now.wrong.readings);
  selection.at_rest = std::move(now.wrong.at_rest);
  selection.outlier_p = now.wrong.p;
  selection.bench = std::move(now.bench);
  selection.noise = std::move(now.noise);
  selection.worth = std::move(now.worth);
  selection.imprints = std::move(now.imprints);
  return selection;
}

}  // namespace lyrefit
