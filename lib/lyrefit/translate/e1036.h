#pragma once

#include <vector>

#include "lyrefit/curve/key_points.h"

namespace lyrefit {

// Key points of readings by ASTM E1036 (and E948), in windows around the key points of
// FindKeyPoints (Isc0, Voc0, Imp0, Vmp0):
//   Isc   straight line I(V) through readings with |V| <= 0.2 Voc0 and I >= 0.96 Isc0, at V = 0
//   Voc   straight line V(I) through readings with |I| <= 0.2 Isc0 and V >= 0.9 Voc0, at I = 0
//   Pmax  maximum of the polynomial P(V) of fourth degree through readings with currents of 0.75 to
//         1.15 Imp0 and voltages of 0.75 to 1.15 Vmp0
// The value of FindKeyPoints stays where a window has fewer readings than 2, 2 and 5, respectively,
// or where the polynomial has no maximum inside its window. Arrays in V and A, of equal length.
KeyPoints E1036KeyPoints(const std::vector<double>& voltage_V,
                         const std::vector<double>& current_A);

}  // namespace lyrefit
