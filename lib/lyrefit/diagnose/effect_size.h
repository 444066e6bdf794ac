#pragma once

#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// Below these nothing is worth a name: root mean square of what an effect does to the curve, in
// parts of Isc, and what it does to Pmax, in parts. Both 0: whatever is there is worth one.
struct Floors {
  double current = 0;
  double power = 0;

  bool Any() const { return current > 0 || power > 0; }
};

// Maximum power of the device by itself, W: the law's device terms under the brightest lit curve's
// conditions, without what the sweep and the instruments did. NaN where there is none.
double DevicePower(const WeightedData& weighted, const LawFit& fit);

// The same beside its standard error in parts: what the readings leave open of the parameters.
struct PowerAndError {
  double power_W;
  double error;
};
PowerAndError DevicePowerAndError(const WeightedData& weighted, const LawFit& fit);

// The fit with effect number `index` taken out of its law, or all of them; all else, the currents
// among them, as it is.
LawFit TakenOut(const LawFit& fit, int index);
LawFit WithoutEffects(const LawFit& fit);

// A fit without the effects that are sized, and what of it serves all of them.
struct Without {
  const LawFit& fit;
  Eigen::MatrixXd basis;  // as Departure takes it
  double power;
};
Without MakeWithout(const WeightedData& weighted, const LawFit& fit);

// How large an effect of a fit is: number `index` of its law, beside the fit without it.
struct EffectSize {
  double current = 0;      // in parts of Isc: what the law without it would miss at its best
  double power = 0;        // in parts: what the law without it gets wrong of Pmax
  double recoverable = 0;  // in parts of Pmax: what the device would give more without it
  double reach = 1;        // half of the current's 95 % interval, in parts of it; 1: down to 0
  // Half of the power's 95 % interval, in parts of Pmax: a moment of the sweep and the device may
  // share the power in any way, and a rough path goes over its peak as well.
  double power_error = 0;
  bool one_sweep = false;  // or one up and down
};
EffectSize SizeOf(const WeightedData& weighted, const LawFit& with, int index, const Without& without);

// Whether the whole interval of one of its sizes lies above the floor.
bool ExceedsFloors(const EffectSize& size, const Floors& floors);

}  // namespace lyrefit
