#pragma once

#include "lyrefit/curve/key_points.h"
#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// Smallest sizes of a named effect; an effect below both is not named. Both 0: every significant
// effect is named. `current`: root mean square of the change of the curve, fraction of Isc.
// `power`: relative change of Pmax.
struct Floors {
  double current = 0;
  double power = 0;

  bool Any() const { return current > 0 || power > 0; }
};

// Maximum power of the device alone, in W: base and device effects at the conditions of the
// brightest lit curve, without effects of the sweep and of instruments. NaN if the law cannot be
// evaluated.
double DevicePower(const WeightedData& weighted, const LawFit& fit);

// Maximum power of the device, in W, and its relative standard error from the parameter
// uncertainty.
struct PowerAndError {
  double power_W;
  double error;
};
PowerAndError DevicePowerAndError(const WeightedData& weighted, const LawFit& fit);

// Additional maximum power of the device without some of its effects, in W, and half of its 95 %
// interval. The interval includes the parameter uncertainty and the rough path at the peak.
struct PowerGain {
  double power_W = kUnknown;
  double half_W = kUnknown;
};
// Of the device without effect number `index`, or without all of its device effects.
PowerGain GainWithout(const WeightedData& weighted, const LawFit& fit, int index);
PowerGain GainWithoutEffects(const WeightedData& weighted, const LawFit& fit);

// Key points of the device alone under the brightest light, in V, A and W.
KeyPoints DeviceKeyPoints(const WeightedData& weighted, const LawFit& fit);

// The fit with effect number `index` removed from its law, or with all effects removed. Remaining
// parameters, sum and currents are copied unchanged, without a new fit.
LawFit TakenOut(const LawFit& fit, int index);
LawFit WithoutEffects(const LawFit& fit);

// A fit without the effects to be sized, with quantities that the sizes of all effects share.
struct Without {
  const LawFit& fit;
  Eigen::MatrixXd basis;  // `plain_basis` of LackOfFit
  double power;
};
Without MakeWithout(const WeightedData& weighted, const LawFit& fit);

// Size of effect number `index` of a fit, compared with a fit without it.
struct EffectSize {
  double current = 0;      // fraction of Isc (rms): lack of fit of the law without it
  double power = 0;        // relative error of Pmax of that law; not finite if it gives no power
  double recoverable = 0;  // relative gain in Pmax of the device without the effect
  double reach = 1;        // half of the current's 95 % interval, relative to it; 1: reaches 0
  // Half of the power's 95 % interval, relative to Pmax. It includes the rough path at the peak,
  // and the ambiguity between momentary sweep effects and the device.
  double power_error = 0;
  bool one_sweep = false;  // one lit curve: one sweep, or one up and down
};
EffectSize SizeOf(const WeightedData& weighted, const LawFit& with, int index,
                  const Without& without);

// Probability that one of its sizes lies above its floor; 1 without floors. A power that is not
// finite does not count.
double ProbabilityAbove(const EffectSize& size, const Floors& floors);
// Whether the whole interval of one of its sizes lies above its floor.
bool ExceedsFloors(const EffectSize& size, const Floors& floors);

}  // namespace lyrefit
