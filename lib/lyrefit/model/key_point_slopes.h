#pragma once

#include <array>

#include "lyrefit/model/device.h"

namespace lyrefit {

// Positions of key points that a fit compares.
enum KeyPointRow { kIscRow, kVocRow, kVmpRow, kPmpRow, kKeyPointRows };
using KeyPointValues = std::array<double, kKeyPointRows>;  // A, V, V, W

// Largest number of parameters of a device in KeyPointsNear.
constexpr int kMostKeyPointParameters = 11;

// Key points of a device without effects, as ModelKeyPoints, but by Newton's steps from values near
// them, such as measured ones (NaN: none known). `slopes`, if not null: their derivatives by the
// device's parameters, kKeyPointRows x device.size(), row by row. At the junction voltage Vj of a
// key point one equation H(Vj, p) = 0 holds, so that dVj = -(dH/dp) dp / (dH/dVj):
//   Isc: Vj - F Rs = 0;   Voc: F = 0;   maximum power: F + (Vj - 2 F Rs) F' = 0,
// where F(Vj, p) is the current. NaN if the device gives no power.
KeyPointValues KeyPointsNear(const Device& device, const double* p, const KeyPointValues& near,
                             double* slopes);

}  // namespace lyrefit
