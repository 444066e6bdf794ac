#pragma once

#include <string>
#include <vector>

#include "lyrefit/curve/curve_set.h"

namespace lyrefit {

// A copy of the set with disordered curves sorted by voltage and without their times and sweeps. A
// curve is disordered if it has at least three monotone stretches, of less than six readings on
// average. `warnings` names each sorted curve.
CurveSet InOrder(const CurveSet& set, std::vector<std::string>* warnings);

// Whether the last voltage is above the first one.
bool Rises(const std::vector<double>& voltage_V);

// Puts the readings of a curve in the opposite order and drops their times.
void Reverse(IvCurve* curve);

// Appends the readings of `next`, a later sweep of the same device, to those of `curve`, and
// numbers the sweeps from 1. Columns that one of the two lacks, and times, are dropped.
void AppendSweep(const IvCurve& next, IvCurve* curve);

// Starts of the monotone stretches of voltage: 0, then every turning point. Reversals of less than
// a fifth of the whole range are ignored as jitter.
std::vector<int> FindTurns(const std::vector<double>& voltage);

}  // namespace lyrefit
