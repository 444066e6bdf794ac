#pragma once

#include <string>
#include <vector>

#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/iv_curve.h"

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

enum class CurrentSign {
  kGenerator,  // delivered current is positive
  kLoad,       // delivered current is negative
  kUnclear,    // the readings fit neither, as if the voltage had the wrong sign
};

// Determines the sign convention of the currents. In generator sign no device has a negative
// current at zero volt, and the current falls as the voltage rises. The current at zero volt
// decides if it is clearly nonzero. It is read near zero volt, or extrapolated by Tukey's resistant
// line. It overrules a weak trend, such as drift on the flat part; a strong contrary trend gives
// kUnclear. Dark curves have no such current; their trend decides.
CurrentSign DetectCurrentSign(const std::vector<double>& voltage_V,
                              const std::vector<double>& current_A);

// Converts the currents to generator sign. `assumptions` records a change, and a sign that could
// not be determined. Voltages are never negated.
void TurnLoadSign(IvCurve* curve);

}  // namespace lyrefit
