#pragma once

#include <vector>

#include "lyrefit/base/groups.h"
#include "lyrefit/diagnose/select.h"

namespace lyrefit {

// A long measurement, replaced by averages of neighbouring readings (base/groups.h).
// Causes are searched and fitted on the averages only. What is averaged is the distance of each
// reading from a fitted base model, so that the curvature of the curve is kept.
struct Averaged {
  // Readings and rounding are those of the averages. The weight of an average is the number of its
  // readings; its scatter is their mean square deviation from it.
  Measurement measurement;
  Grouping first;  // readings of each average
};

// Whether the measurement has enough readings to be averaged.
bool IsLong(const Readings& readings);

// Averages a measurement. Readings at an instrument limit and sudden outliers keep a group of their
// own, and no average spans a jump of the current. `base`: law of the model that is subtracted.
Averaged Average(const Measurement& measurement, const Law& base, const ProgressReporter& progress);

// The fits of a selection, evaluated at every reading.
struct AtReadings {
  WeightedData weighted;  // noise deviation of each reading, from the extended model
  Noise noise;            // estimated from the residuals of the extended model
  std::vector<double> base, extended, without;  // currents in scales; `without`: causes removed
  Grouping first;                               // readings of each position of the selection
};

// For a selection on all readings.
AtReadings AtItsReadings(const Selection& selection);

// For a selection on averages of `measurement`. The result refers to `measurement`, which must
// outlive it.
AtReadings AtItsReadings(const Selection& selection, const Averaged& averaged,
                         const Measurement& measurement);

}  // namespace lyrefit
