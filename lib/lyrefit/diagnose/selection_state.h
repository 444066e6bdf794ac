#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "lyrefit/diagnose/select.h"
#include "lyrefit/diagnose/wrong_readings.h"

namespace lyrefit {

// State of a selection, shared by its steps.
struct SelectionState {
  const Measurement& measurement;
  const SelectOptions& options;
  Signatures signatures;
  WeightedData weighted;
  Noise noise;
  LawFit base;  // without causes
  LawFit fit;   // with the causes found so far
  std::vector<ChosenCause> causes;
  WrongReadings wrong;
  Hypotheses trials = {}, below = {};  // see Selection, as `none`
  double none = 1;
  // Fits of the last step, of which some readings are left out since: fits with the same causes go
  // on from there.
  std::vector<FittedCandidate> earlier = {};
};

// Receives the stages. Repetitions of the selection report to nobody.
inline ProgressReporter ReporterOf(const SelectionState& now) {
  return now.options.repeats ? ProgressReporter() : now.options.progress;
}

// Estimates the noise from the residuals of the present fit and repeats the fit with it.
inline void SettleNoise(SelectionState* now) {
  SettledFit settled = SettleNoise(now->measurement, std::move(now->weighted), std::move(now->fit));
  now->weighted = std::move(settled.weighted);
  now->fit = std::move(settled.fit);
  now->noise = std::move(settled.noise);
}

// Scores all effects that can be added to the present law.
std::vector<Score> ScoreOpen(SelectionState* now);

// Fits and judges the effects whose score makes a success possible.
Hypotheses FitCandidates(const SelectionState& now, const std::vector<Score>& scores);

// Replaces every cause but the last one by another effect if that is more probable together with
// the other causes, and removes those without which the law is more probable.
void SwapCauses(SelectionState* now);

}  // namespace lyrefit
