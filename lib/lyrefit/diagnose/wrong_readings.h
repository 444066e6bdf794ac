#pragma once

#include <optional>
#include <vector>

#include "lyrefit/diagnose/fitted_candidate.h"

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

}  // namespace lyrefit
