#pragma once

#include <vector>

#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// A curve without duplicate readings. An exact copy of a reading adds no information about the
// device.
struct DistinctReadings {
  IvCurve curve;               // in order of first occurrence
  std::vector<double> copies;  // multiplicity of each reading; empty: all 1
};

// Copies have equal voltage, current, sigma and time. Repeated measurements of one point differ in
// their noise and are all kept.
DistinctReadings FindDistinctReadings(const IvCurve& curve);

}  // namespace lyrefit
