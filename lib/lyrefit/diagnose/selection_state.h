#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "lyrefit/diagnose/fitted_candidate.h"
#include "lyrefit/diagnose/select.h"

namespace lyrefit {

// Single readings that were left out of the fit.
struct WrongReadings {
  std::vector<int> readings;
  std::vector<int> at_rest;  // not wrong, but the voltage stood still: ends of monotone stretches
};

inline constexpr double kMostWrong = 0.05;  // of all readings

// A reading that is left out, and the fit without it.
struct LeftOut {
  int reading = 0;
  bool at_rest = false;  // see WrongReadings
  LawFit fit;
};

// The reading that is furthest off, if leaving it out is more probable than no cause and than the
// best of the candidates, or if it is isolated where that one is momentary. None where a twentieth
// of all readings is wrong (`wrong` of them) already.
std::optional<LeftOut> FindFurthest(const WeightedData& weighted, const LawFit& fit,
                                    const std::vector<Score>& scores, const Hypotheses& step,
                                    std::size_t wrong);

// Whether a fit explains a reading, used or not.
bool Explains(const WeightedData& weighted, const LawFit& fit, int reading);

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
