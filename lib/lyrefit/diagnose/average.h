#pragma once

#include <vector>

#include "lyrefit/diagnose/select.h"

namespace lyrefit {

// A long measurement with neighbouring readings averaged: what is looked at while causes are
// sought. Averages are taken of the distances from a fitted base model, so that bends of the curve
// are not averaged away.
struct Averaged {
  Measurement measurement;                // positions and rounding of its values are the averages'
  std::vector<std::vector<int>> members;  // readings behind each average
};

// Whether the measurement is long enough to be averaged.
bool IsLong(const Readings& readings);

// Readings that clipping or a sudden value sets apart stay by themselves.
Averaged Average(const Measurement& measurement, const Law& base, Watch* watch);

// What was found in the averages, fitted to all readings: fits, noise, what is left out. Scores and
// p-values stay those of the averages.
Selection OnAllReadings(const Selection& found, const Averaged& averaged,
                        const Measurement& measurement);

}  // namespace lyrefit
