#pragma once

#include <vector>

#include "lyrefit/diagnose/fitted_candidate.h"

namespace lyrefit {

// Single readings that were left out of the fit.
struct WrongReadings {
  std::vector<int> readings;
  std::vector<int> at_rest;  // not wrong, but the voltage stood still: ends of monotone stretches
};

inline constexpr double kMostWrong = 0.05;  // of all readings

// Leaves out the reading that is furthest off and repeats the fit, if that is more probable than no
// cause and than the best of the candidates, or if it is isolated where that one is momentary. At
// most a twentieth of all readings is left out. Returns whether a reading was left out.
bool LeaveOutFurthest(const std::vector<Score>& scores, const Hypotheses& step,
                      WeightedData* weighted, LawFit* fit, WrongReadings* wrong);

// Uses left-out readings again that the present fit explains, and repeats the fit. Returns whether
// there were any.
bool Readmit(WeightedData* weighted, LawFit* fit, WrongReadings* wrong);

}  // namespace lyrefit
