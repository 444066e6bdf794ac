#pragma once

#include <vector>

#include "lyrefit/diagnose/effect_size.h"
#include "lyrefit/diagnose/fitted_candidate.h"
#include "lyrefit/diagnose/measurement.h"
#include "lyrefit/diagnose/noise.h"
#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

struct SelectOptions {
  JudgeOptions judge;
  double probability = 0.8;  // a cause is added if it is at least as probable, against none
  Signatures signatures;     // computed by the selection that this one repeats
  int largest_causes = 4;
  Floors floors;
  Law base;                        // initial variant of the base law
  std::vector<double> start;       // parameters of `base`, which is then final; empty: unknown
  bool repeats = false;            // repeats a selection on fewer readings: fits start from the
                                   // best probe only, no cause is swapped, no stage is reported
  bool thorough = false;           // no fit is saved: the same verdict, for tests of that
  int most_fitted_candidates = 0;  // number of effects fitted in a step, by score; 0: all
  LawFit hint;                     // earlier fit with effects, as further start; may be unusable
  const std::vector<FittedCandidate>* met = nullptr;  // earlier fits of each effect with `base`
  std::vector<const Effect*> candidates;              // possible for the type of data
  ProgressReporter progress;
};

struct ChosenCause {
  const Effect* effect = nullptr;
  Score score;             // when it was added
  bool in_values = false;  // it shows in the values themselves and is never removed
  double probability = 1;  // that it stands in its place, not one of `others` and not nothing
  Hypotheses others = {};  // in its place, beside the other causes; by FindAlternatives
};

struct Selection {
  LawFit base;
  LawFit extended;                  // equal to base if nothing was found
  std::vector<ChosenCause> causes;  // in the order of extended.law.effects
  std::vector<int> outliers;        // readings left out as wrong
  std::vector<int> at_rest;         // readings left out where the voltage stood still
  Hypotheses trials;                // each effect fitted with the base model
  Hypotheses below;                 // of the last step: its best candidate is below the floors
  double incomplete = 0;            // probability that something unknown acts as well
  double none = 1;                  // probability that nothing acts at all
  WeightedData weighted;            // with the noise of the extended model
  WeightedData base_weighted;       // with the noise of the base model
  Noise noise;
  Signatures signatures;  // computed during this selection
};

// Selects causes one by one, as long as one more is more probable than none, with backward steps
// and swaps; the README of this module lists the steps. `used`: 1 for readings that may be fitted.
// `correlation`: lag-1 correlation of the noise. An unusable base model gives a result with
// `base.usable` false.
Selection SelectCauses(const Measurement& measurement, const std::vector<char>& used,
                       double correlation, const SelectOptions& options);

// Estimates the noise from the residuals of `fit` and sets sigma and least_variance of `weighted`.
Noise TakeNoise(const Measurement& measurement, const LawFit& fit, WeightedData* weighted);

// A fit whose noise is that of its own residuals.
struct SettledFit {
  WeightedData weighted;  // with that noise
  LawFit fit;
  Noise noise;
};

// Estimates the noise from the residuals of `fit` and repeats the fit with it; two rounds.
SettledFit SettleNoise(const Measurement& measurement, WeightedData weighted, LawFit fit);

// The hypotheses that may stand in the place of a cause, beside the cause itself: those with a
// twentieth of its probability or more, most probable first. Empty for a cause in the values.
std::vector<const FittedCandidate*> EquivalentsOf(const ChosenCause& cause);

// The cause's own entry among the hypotheses of its place; nullptr if absent.
const FittedCandidate* OwnCandidate(const ChosenCause& cause);

// Fills `others` and `probability` of every cause: nothing or any effect that could take its place.
// One that is more probable there under the final noise replaces it.
void FindAlternatives(const Measurement& measurement, const SelectOptions& options,
                      Selection* selection);

}  // namespace lyrefit
