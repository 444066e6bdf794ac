#pragma once

#include <vector>

#include "lyrefit/diagnose/fitted_candidate.h"

namespace lyrefit {

// Single readings that were left out of the fit.
struct WrongReadings {
  std::vector<int> readings;
  std::vector<int> at_rest;  // not wrong, but the voltage stood still: ends of monotone stretches
  double p = 1;              // smallest corrected p-value of `readings`
};

// Whether the statistic of the furthest single reading exceeds those of all fittable effects by
// far.
bool StandsOut(const std::vector<Score>& scores);

// Leaves out the reading that is furthest off and repeats the fit, if it is significant at `level`.
// It must also explain more than the best of `fitted_candidates`, or be isolated where that effect
// is momentary. At most a twentieth of all readings is left out. Returns whether a reading was left
// out.
bool LeaveOutFurthest(const std::vector<Score>& scores,
                      const std::vector<FittedCandidate>& fitted_candidates, double level,
                      WeightedData* weighted, LawFit* fit, WrongReadings* wrong);

// Uses left-out readings again that the present fit explains, and repeats the fit. Returns whether
// there were any.
bool Readmit(WeightedData* weighted, LawFit* fit, WrongReadings* wrong);

}  // namespace lyrefit
