#pragma once

#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// Readings of a lit curve far beyond open circuit that do not belong to its diode. A sweep may go
// on until the forward current is many times Isc. There injection, leads and other conduction add
// to the device, and each reading outweighs all readings up to Voc.
struct BeyondVoc {
  double most_A = 0;     // largest forward current of the readings that belong to the diode, >= 0
  int left_out = 0;      // readings beyond it; 0: all readings belong to the diode
  double largest_A = 0;  // largest forward current of all readings
};

// Compares a junction with series resistance, V = a + b ln(J) - Rs I, with the readings. All belong
// to the diode if its misfit stays within 1 % of Isc, or within twice that of the readings up to
// Voc. Otherwise those up to the first reading beyond Voc do. Sweeps whose forward current stays
// below Isc keep all readings. So do dark curves and those that do not show Isc and Voc.
BeyondVoc FindBeyondVoc(const IvCurve& curve);

// The curve without these readings. An assumption then tells their number and the reason. A curve
// to be taken as it is (`as_is`) stays as it is.
IvCurve WithoutBeyondVoc(IvCurve curve);

}  // namespace lyrefit
