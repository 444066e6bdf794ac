#pragma once

#include "lyrefit/curve/key_points.h"
#include "lyrefit/model/device.h"

namespace lyrefit {

// Isc, Voc and the maximum power point of a device's model curve, with a relative error of about
// 1e-12. With effects they are read from a fine sweep, with an error of about 1e-6. Voc and all
// that depends on it is NaN if the device gives no power (a dark curve).
KeyPoints ModelKeyPoints(const Device& device, const double* p);

// Voc alone, in V, at lower cost.
double ModelOpenCircuit(const Device& device, const double* p);

}  // namespace lyrefit
