#pragma once

#include "lyrefit/curve/key_points.h"
#include "lyrefit/law/device.h"

namespace lyrefit {

// Isc, Voc and the maximum power point of a device's own curve, to about 1e-12 relative (of one
// with effects read off a fine sweep, to some 1e-6). NaN for Voc and what follows from it where the
// device gives no power (a dark curve).
KeyPoints ModelKeyPoints(const Device& device, const double* p);

// Voc alone, which is cheaper.
double ModelOpenCircuit(const Device& device, const double* p);

}  // namespace lyrefit
