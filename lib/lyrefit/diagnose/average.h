#pragma once

#include <vector>

#include "lyrefit/diagnose/select.h"

namespace lyrefit {

// A long measurement in averages of neighbouring readings (fit/average_neighbours.h): causes are
// sought and fitted in them alone. Averages are taken of the distances from a fitted base model, so
// that bends of the curve are not averaged away.
struct Averaged {
  // Positions and rounding of its values are the averages'. The weight of an average is the number
  // of its readings, its scatter theirs about it.
  Measurement measurement;
  std::vector<int> first;  // reading of every average, and the end
};

// Whether the measurement is long enough to be averaged.
bool IsLong(const Readings& readings);

// Readings that clipping or a sudden value sets apart stay by themselves, and no average goes over
// a jump of the current.
Averaged Average(const Measurement& measurement, const Law& base, Watch* watch);

// The fits of a selection at every reading.
struct AtReadings {
  WeightedData weighted;  // how far each reading is trusted beside the extended model
  Noise noise;      // beside the same
  std::vector<double> base, extended, without;  // currents in scales; `without` the causes
  std::vector<int> first;  // reading of every position of the selection, and the end

  // Readings at positions of the selection.
  std::vector<int> Behind(const std::vector<int>& positions) const;
};

// Of a selection in all readings.
AtReadings AtItsReadings(const Selection& selection);

// Of a selection in averages of the measurement, which outlives it.
AtReadings AtItsReadings(const Selection& selection, const Averaged& averaged,
                         const Measurement& measurement);

}  // namespace lyrefit
