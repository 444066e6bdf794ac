#pragma once

#include <vector>

#include "lyrefit/diagnose/fitted_candidate.h"

namespace lyrefit {

// Single readings that were left out.
struct WrongReadings {
  std::vector<int> readings;
  std::vector<int> at_rest;  // not wrong: at an end of a stretch, where the voltage stood still
  double p = 1;              // corrected, the smallest of them
};

// Whether a single reading is off by far more than any cause promises to explain.
bool StandsOut(const std::vector<Score>& scores);

// Leaves out the reading that is furthest off where that is certain at `level` and explains more
// than the best of `fitted_candidates`, or is alone where that acts at a moment; at most a twentieth of all.
// Says whether it did; the fit is then one without it.
bool LeaveOutFurthest(const std::vector<Score>& scores, const std::vector<FittedCandidate>& fitted_candidates,
                      double level, WeightedData* weighted, LawFit* fit, WrongReadings* wrong);

// Takes back what causes that were found since explain, and says whether there was any.
bool Readmit(WeightedData* weighted, LawFit* fit, WrongReadings* wrong);

}  // namespace lyrefit
