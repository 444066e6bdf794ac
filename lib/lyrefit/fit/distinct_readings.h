#pragma once

#include <vector>

#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// A curve with each reading once. An exact copy of a reading says nothing new about the device.
struct DistinctReadings {
  IvCurve curve;               // in the order of the first of each
  std::vector<double> copies;  // how often each is in the file; empty: every reading is there once
};

// Copies have the same voltage, current, sigma and time. Repeated measurements of one point differ
// in their noise and all count.
DistinctReadings FindDistinctReadings(const IvCurve& curve);

}  // namespace lyrefit
