#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lyrefit/diagnose/effect_size.h"
#include "lyrefit/diagnose/fitted_candidate.h"
#include "lyrefit/diagnose/measurement.h"
#include "lyrefit/diagnose/noise.h"
#include "lyrefit/diagnose/score.h"
#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// Fraction of the level that applies to every cause after the first, since each further step adds a
// chance of a false alarm.
constexpr double kLaterLevel = 0.2;

struct SelectOptions {
  double level = 0.05;
  int draws = 2000;
  std::shared_ptr<const ScoreCalibration> calibration;  // of the list; null: simulated
  Signatures signatures;  // computed by the selection that this one repeats
  int largest_causes = 4;
  Floors floors;
  std::uint64_t seed = 1;
  Law base;                        // initial variant of the base law
  std::vector<double> start;       // parameters of `base`, which is then final; empty: unknown
  bool trials = true;              // fit every effect on the base model for the record, and report
                                   // stages to `progress`
  int most_fitted_candidates = 0;  // number of effects fitted in a step, by score; 0: all
  LawFit hint;                     // earlier fit with effects, as further start; may be unusable
  bool in_passing = false;         // fits start from the best probe only, and no cause is exchanged
                                   // later
  const std::vector<FittedCandidate>* met = nullptr;  // earlier fits of each effect with `base`
  std::vector<const Effect*> candidates;              // possible for the type of data
  ProgressReporter progress;
};

struct ChosenCause {
  const Effect* effect = nullptr;
  double corrected_p = 1;                          // when it was added
  Score score;                                     // when it was added
  std::vector<FittedCandidate> fitted_candidates;  // every effect in its place, best first
  bool in_values = false;  // it shows in the values themselves and is never removed
};

struct Selection {
  LawFit base;
  LawFit extended;                  // equal to base if nothing was found
  std::vector<ChosenCause> causes;  // in the order of extended.law.effects
  std::vector<LawFit> without;      // without each cause; by FindFittedCandidates
  std::vector<int> outliers;        // readings left out as wrong
  std::vector<int> at_rest;         // readings left out where the voltage stood still
  double outlier_p = 1;
  std::vector<FittedCandidate> trials;  // each effect fitted with the base model
  double unknown_p = 1;  // corrected, of unexplained structure in the residuals of `extended`
  bool unknown = false;  // unexplained structure is the verdict
  std::vector<FittedCandidate> below;  // significant, but below the floors; best first
  WeightedData weighted;               // with the noise of the extended model
  WeightedData base_weighted;          // with the noise of the base model
  Noise noise;
  std::shared_ptr<const ScoreCalibration> calibration;
  Signatures signatures;  // computed during this selection
};

// Selects causes by stepwise forward selection with backward steps and swaps; the README of this
// module lists the steps. `used`: 1 for readings that may be fitted. `correlation`: lag-1
// correlation of the noise. An unusable base model gives a result with `base.usable` false.
Selection SelectCauses(const Measurement& measurement, const std::vector<char>& used,
                       double correlation, const SelectOptions& options);

// Estimates the noise from the residuals of `fit` and sets sigma and least_variance of `weighted`.
Noise TakeNoise(const Measurement& measurement, const LawFit& fit, WeightedData* weighted);

// Estimates the noise from the residuals of `fit` and repeats the fit with it; two rounds.
Noise SettleNoise(const Measurement& measurement, WeightedData* weighted, LawFit* fit);

// Fills `without` and, for every cause, `fitted_candidates`: all effects that could take its place.
void FindFittedCandidates(const SelectOptions& options, Selection* selection);

}  // namespace lyrefit
