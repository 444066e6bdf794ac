#include "lyrefit/diagnose/select.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "lyrefit/diagnose/choose_base.h"
#include "lyrefit/diagnose/fit_effect.h"
#include "lyrefit/diagnose/rank_causes.h"
#include "lyrefit/diagnose/selection_state.h"
#include "lyrefit/diagnose/weigh_candidates.h"
#include "lyrefit/model/effects/catalogue.h"

namespace lyrefit {
namespace {

SelectionState BeginSelection(const Measurement& measurement, const std::vector<char>& used,
                              double correlation, const SelectOptions& options) {
  SelectionState now{measurement, options, options.calibration, options.signatures, {}, {}, {},
                     {},          {}};
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
bool SettleBase(SelectionState* now, Selection* selection) {
  ReporterOf(*now).Begin("base fit", 3);
  Law law = now->options.base;
  if (now->weighted.readings->points.size() <= kQuickToFit) now->weighted.progress = {};
  FitBaseLaw(law, now);
  now->weighted.progress = now->options.progress;
  selection->base = selection->extended = now->fit;
  selection->weighted = selection->base_weighted = now->weighted;
  if (!now->fit.usable) return false;
  ReporterOf(*now).Count();
  SettleNoise(now);
  ReporterOf(*now).Count();
  if (now->options.start.empty()) law = ChooseLaw(now->weighted, law);
  FitBaseLaw(law, now);
  if (now->weighted.progress.Stopped()) now->fit = selection->base;
  selection->base = now->fit;
  selection->base_weighted = now->weighted;
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
  now->causes.push_back({clip, 0, {}, {}, true});
  SettleNoise(now);
}

void FindCalibration(const Prepared& prepared, SelectionState* now) {
  if (now->calibration != nullptr) return;
  const bool voltage = now->noise.lit.voltage > 0 || now->noise.dark.voltage > 0;
  const NoiseEstimator noise(now->measurement, now->weighted.used,
                             voltage ? VoltageNoise::kAlways : VoltageNoise::kNever);
  now->calibration = std::make_shared<const ScoreCalibration>(
      CalibrateScores(now->weighted, prepared, &noise, now->options.draws, now->options.seed));
}

// Whether a later cause explains a sufficient part of the first cause's statistic. Otherwise it may
// only correct an error of the first cause's model. Used without floors.
bool ExplainsEnough(const SelectionState& now, const FittedCandidate& fitted) {
  constexpr double kLaterPart = 0.02, kGenericPart = 0.05;
  const bool generic = IsGeneric(*now.weighted.readings, *fitted.score.effect);
  return fitted.statistic >= (generic ? kGenericPart : kLaterPart) * now.first_gain;
}

// Whether the misfit of the base model is so large that scores on its residuals are meaningless.
bool IsRuined(const SelectionState& now) {
  constexpr double kMisfit = 0.01;
  if (!now.measurement.has_path()) return false;
  return MissedBy(now.weighted, now.fit) > kMisfit;
}

// Sets the level of this step. Returns whether any score passes it.
bool IsAnythingThere(const std::vector<Score>& scores, int step, SelectionState* now) {
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

// Adds effects that were scored but not fitted.
void AddUntried(const std::vector<Score>& scores, std::vector<FittedCandidate>* trials) {
  for (const Score& score : scores) {
    const bool there = std::any_of(trials->begin(), trials->end(), [&](const FittedCandidate& r) {
      return r.score.effect == score.effect;
    });
    if (!there) trials->push_back({score, {}, 0});
  }
}

bool LeaveOut(const std::vector<Score>& scores,
              const std::vector<FittedCandidate>& fitted_candidates, SelectionState* now) {
  const bool left_out = LeaveOutFurthest(scores, fitted_candidates, now->level, &now->weighted,
                                         &now->fit, &now->wrong);
  if (left_out) SettleNoise(now);
  return left_out;
}

// Keeps the fitted candidates that are large enough to be named. False if none of them is.
bool KeepWorthy(SelectionState* now, Selection* selection,
                std::vector<FittedCandidate>* fitted_candidates) {
  const bool first = now->causes.empty();
  if (now->options.floors.Any()) {
    selection->below.clear();
    *fitted_candidates = Weigh(*now, *fitted_candidates, &selection->below);
    if (fitted_candidates->empty()) return false;
    if (first) {
      const double taken =
          LackOfFit(now->weighted, now->fit, fitted_candidates->front().fit.current);
      now->first_misfit = std::pow(taken, 2);
    }
    return true;
  }
  if (fitted_candidates->empty()) return true;
  if (first) now->first_gain = fitted_candidates->front().statistic;
  return ExplainsEnough(*now, fitted_candidates->front());
}

// Frees the shape parameters of a momentary effect if the improvement exceeds their penalty.
void FreeShape(const Effect& effect, SelectionState* now) {
  const LawFit& fit = now->fit;
  Law law = fit.law;
  for (int k = 0; k < effect.size(); ++k) {
    if (effect.parameters[k].fixed_by_default) law.freed.emplace_back(&effect, k);
  }
  if (law.freed.size() == fit.law.freed.size()) return;
  LawFit freed = FitLaw(now->weighted, law, fit.p);
  const double paid = FreedomOf(now->weighted, law) - FreedomOf(now->weighted, fit.law);
  if (!freed.usable) return;
  if (!(freed.sum + paid * NoiseVariance(now->weighted, freed) < fit.sum)) return;
  now->fit = std::move(freed);
  SettleNoise(now);
}

bool Accept(const FittedCandidate& fitted, SelectionState* now) {
  const Effect& effect = *fitted.score.effect;
  const bool floors = now->options.floors.Any();
  double p = fitted.corrected_p;
  const bool proven = floors && now->causes.empty() && effect.where == Where::kSweep &&
                      LightMoved(*now->weighted.readings);
  if (proven) p = 0;
  if (!(p < now->level)) return false;
  now->fit = fitted.fit;
  now->causes.push_back({&effect, p, fitted.score, {}});
  SettleNoise(now);
  if (floors && effect.momentary) FreeShape(effect, now);
  return true;
}

void Extend(Prepared prepared, SelectionState* now, Selection* selection) {
  const SelectOptions& options = now->options;
  const int most = options.largest_causes + static_cast<int>(now->causes.size());
  std::set<std::set<const Effect*>> seen;
  std::vector<FittedCandidate> fitted_candidates;  // of a previous step that left out a reading
  for (int step = 0;; ++step) {
    if (step > 0) prepared = PrepareOpen(now);
    const std::vector<Score> scores = JudgeScores(prepared, *now->calibration);
    if (now->weighted.progress.Stopped()) return;
    selection->unknown_p = UnknownP(scores);
    const bool is_there = IsAnythingThere(scores, step, now);
    if (step == 0 && options.trials) {
      selection->trials = fitted_candidates = FitCandidates(*now, scores, true, is_there);
      AddUntried(scores, &selection->trials);
    }
    if (!is_there) return;
    if (static_cast<int>(now->causes.size()) >= most) return;
    // Candidates fitted in the previous step are reused if another reading stands out by far:
    // causes gain little when one reading is left out.
    const bool left = step > 0 && !fitted_candidates.empty();
    if (left && StandsOut(scores) && LeaveOut(scores, fitted_candidates, now)) continue;
    if (step > 0 || !options.trials) fitted_candidates = FitCandidates(*now, scores);
    if (now->weighted.progress.Stopped()) return;
    if (LeaveOut(scores, fitted_candidates, now)) continue;
    if (!KeepWorthy(now, selection, &fitted_candidates)) return;
    if (fitted_candidates.empty() || !Accept(fitted_candidates.front(), now)) {
      selection->unknown =
          now->causes.empty() && now->wrong.readings.empty() && selection->unknown_p < now->level;
      return;
    }
    selection->below.clear();  // they refer to the previous model
    SwapCauses(now);
    Prune(now);
    if (Readmit(&now->weighted, &now->fit, &now->wrong)) SettleNoise(now);
    const std::vector<const Effect*>& effects = now->fit.law.effects;
    const std::set<const Effect*> present(effects.begin(), effects.end());
    if (!seen.insert(present).second) return;  // a set of causes recurred: stop
    fitted_candidates.clear();
  }
}

}  // namespace

Prepared PrepareOpen(SelectionState* now) {
  const std::vector<const Effect*> open = RoomFor(now->fit.law, now->options.candidates);
  return PrepareAll(now->weighted, now->fit, open, &now->signatures);
}

std::vector<FittedCandidate> Weigh(const SelectionState& now,
                                   const std::vector<FittedCandidate>& all,
                                   std::vector<FittedCandidate>* below) {
  const Weights weights{now.options.floors, now.level, now.first_misfit};
  return WeighCandidates(now.weighted, now.fit, all, weights, below);
}

Selection SelectCauses(const Measurement& measurement, const std::vector<char>& used,
                       double correlation, const SelectOptions& options) {
  SelectionState now = BeginSelection(measurement, used, correlation, options);
  Selection selection;
  if (!SettleBase(&now, &selection)) return selection;
  if (measurement.values.HasLimits()) AddClip(&now);
  Prepared prepared = PrepareOpen(&now);
  FindCalibration(prepared, &now);
  Extend(std::move(prepared), &now, &selection);
  selection.extended = std::move(now.fit);
  selection.causes = std::move(now.causes);
  selection.outliers = std::move(now.wrong.readings);
  selection.at_rest = std::move(now.wrong.at_rest);
  selection.outlier_p = now.wrong.p;
  selection.weighted = std::move(now.weighted);
  selection.noise = std::move(now.noise);
  selection.calibration = std::move(now.calibration);
  selection.signatures = std::move(now.signatures);
  return selection;
}

}  // namespace lyrefit
