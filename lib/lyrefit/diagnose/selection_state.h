#pragma once

#include <memory>
#include <vector>

#include "lyrefit/diagnose/select.h"
#include "lyrefit/diagnose/wrong_readings.h"

namespace lyrefit {

// A selection on its way, as its steps hand it to each other.
struct SelectionState {
  const Measurement& measurement;
  const SelectOptions& options;
  std::shared_ptr<const ScoreCalibration> calibration;
  Signatures signatures;
  WeightedData weighted;
  Noise noise;
  LawFit fit;  // of the causes that were found so far
  std::vector<ChosenCause> causes;
  WrongReadings wrong;
  double level = 0;         // of the present step
  double first_gain = 0;    // statistic of the first cause that was fitted
  double first_misfit = 0;  // mean square of what the first cause took away, in scales
};

// The watch hears of the selection itself, not of its repetitions.
inline Watch* ObserverOf(const SelectionState& now) {
  return now.options.trials ? now.options.watch : nullptr;
}

// Noise from the residuals of the present law, which is then fitted anew.
inline void SettleNoise(SelectionState* now) {
  now->noise = SettleNoise(now->measurement, &now->weighted, &now->fit);
}

// What the effects beside the present law are scored on.
Prepared PrepareOpen(SelectionState* now);

// Fits the effects that stand a chance, the best first; with `all` the others as well, for the
// record. Where nothing `is_there` all are.
std::vector<FittedCandidate> FitCandidates(const SelectionState& now, const std::vector<Score>& scores,
                             bool all = false, bool is_there = true);

// WeighRivals at the present step.
std::vector<FittedCandidate> Weigh(const SelectionState& now, const std::vector<FittedCandidate>& all,
                         std::vector<FittedCandidate>* below);

// Every cause but the last gives its place to any effect that does better beside the others.
void SwapCauses(SelectionState* now);

// Drops causes that the later ones made idle.
void Prune(SelectionState* now);

}  // namespace lyrefit
