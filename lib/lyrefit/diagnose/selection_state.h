#pragma once

#include <memory>
#include <vector>

#include "lyrefit/diagnose/select.h"
#include "lyrefit/diagnose/wrong_readings.h"

namespace lyrefit {

// State of a selection, shared by its steps.
struct SelectionState {
  const Measurement& measurement;
  const SelectOptions& options;
  std::shared_ptr<const ScoreCalibration> calibration;
  Signatures signatures;
  WeightedData weighted;
  Noise noise;
  LawFit fit;  // with the causes found so far
  std::vector<ChosenCause> causes;
  WrongReadings wrong;
  double level = 0;         // significance level of the present step
  double first_gain = 0;    // statistic of the first fitted cause
  double first_misfit = 0;  // mean square removed by the first cause, in squared scales
};

// Receives the stages. Repetitions of the selection report to nobody.
inline ProgressReporter ReporterOf(const SelectionState& now) {
  return now.options.trials ? now.options.progress : ProgressReporter();
}

// Estimates the noise from the residuals of the present fit and repeats the fit with it.
inline void SettleNoise(SelectionState* now) {
  now->noise = SettleNoise(now->measurement, &now->weighted, &now->fit);
}

// Prepares scores of all effects that can be added to the present law.
Prepared PrepareOpen(SelectionState* now);

// Fits the effects whose score makes a success possible; result: best first. With `all`, the others
// are fitted as well, briefly, for the record. Without `is_there` (no score is significant), all
// fits are brief.
std::vector<FittedCandidate> FitCandidates(const SelectionState& now,
                                           const std::vector<Score>& scores, bool all = false,
                                           bool is_there = true);

// WeighCandidates with the floors and the level of the present step.
std::vector<FittedCandidate> Weigh(const SelectionState& now,
                                   const std::vector<FittedCandidate>& all,
                                   std::vector<FittedCandidate>* below);

// Replaces every cause but the last one by another effect if that fits better together with the
// other causes.
void SwapCauses(SelectionState* now);

// Removes causes that are no longer significant beside later ones.
void Prune(SelectionState* now);

}  // namespace lyrefit
