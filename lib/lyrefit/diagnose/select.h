#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lyrefit/diagnose/effect_size.h"
#include "lyrefit/diagnose/measurement.h"
#include "lyrefit/diagnose/noise.h"
#include "lyrefit/diagnose/fitted_candidate.h"
#include "lyrefit/diagnose/score.h"
#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// Every cause after the first must pass this part of the level: each step is one more chance to be
// wrong.
constexpr double kLaterLevel = 0.2;

struct SelectOptions {
  double level = 0.05;
  int draws = 2000;
  std::shared_ptr<const ScoreCalibration> calibration;  // of the list; simulated where there is none
  Signatures signatures;                        // of the laws met by a selection that this one repeats
  int largest_causes = 4;
  Floors floors;
  std::uint64_t seed = 1;
  Law base;                   // a variant that the data prefer may take its place
  std::vector<double> start;  // of `base`, which is then kept; empty: none is known
  bool trials = true;         // fit every effect on the base model, wanted or not, and
                              // tell the watch of the stages
  int most_fitted_candidates = 0;        // fitted at a step, the best by score; 0: all
  LawFit hint;                // where effects were found before; usable or not
  bool in_passing = false;    // each of them from its best probe alone,
                              // and no cause exchanged for another later
  const std::vector<FittedCandidate>* met = nullptr;  // there, each effect beside `base`
  std::vector<const Effect*> candidates;    // allowed by the kind of data
  Watch* watch = nullptr;
};

struct ChosenCause {
  const Effect* effect = nullptr;
  double corrected_p = 1;     // when it entered
  Score score;                // then
  std::vector<FittedCandidate> fitted_candidates;  // every effect in its place, the best first, itself among them
  bool in_values = false;     // it shows in the values themselves, and stays
};

struct Selection {
  LawFit base;
  LawFit extended;                  // base where nothing was found
  std::vector<ChosenCause> causes;  // in the order of extended.law.effects
  std::vector<LawFit> without;      // the extended law without each cause, filled by FindRivals
  std::vector<int> outliers;        // readings left out as wrong
  std::vector<int> at_rest;         // left out where the voltage stood still
  double outlier_p = 1;
  std::vector<FittedCandidate> trials;  // each effect on the base model
  double unknown_p = 1;       // corrected, of unknown structure in what `extended` leaves
  bool unknown = false;       // it is the verdict
  std::vector<FittedCandidate> below;   // there, but below the floor; the best first
  WeightedData weighted;            // with the noise of the extended model
  WeightedData base_weighted;       // with the noise of the base model
  Noise noise;
  std::shared_ptr<const ScoreCalibration> calibration;
  Signatures signatures;  // of the laws met on the way
};

// Extend-and-repeat with a backward step and swaps, as described in the README of this module.
// `used` marks readings that may be looked at.
Selection SelectCauses(const Measurement& measurement, const std::vector<char>& used,
                       double correlation, const SelectOptions& options);

// Noise of the readings from a fit's residuals, and how far each of them is trusted.
Noise TakeNoise(const Measurement& measurement, const LawFit& fit, WeightedData* weighted);

// Noise from the residuals of the present law, which is then fitted anew, twice.
Noise SettleNoise(const Measurement& measurement, WeightedData* weighted, LawFit* fit);

// Fills `without` and the `fitted_candidates` of every cause: who could stand in its place.
void FindFittedCandidates(const SelectOptions& options, Selection* selection);

}  // namespace lyrefit
