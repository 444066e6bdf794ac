// Devices of which the truth at standard conditions is known: by laws that are no procedure's, and
// modules built cell by cell (hidden/field_*), healthy or with a fault.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/translate/device_coefficients.h"

namespace shown {

// A measured curve, what a data sheet would say of the device, and what it would give in truth.
struct MadeCase {
  lyrefit::IvCurve curve;
  lyrefit::StatedCoefficients coefficients;
  lyrefit::KeyPoints stc{};
};

// "PVsyst", "two diodes", "cells".
std::vector<std::string> Worlds();
// Light drawn evenly between both (W/m2), 5 C and more.
struct Light {
  double lowest_W_m2 = 250;
  double highest_W_m2 = 1100;
};
MadeCase MakeReferenceSweeps(const std::string& world, const Light& light, std::uint64_t seed);

// Kinds of faults: of hidden/field_*, and a shunt over every cell or a resistance in series. Those
// of the sweep are not in the truth.
std::vector<std::string> FaultKinds();
MadeCase MakeFaulty(const std::string& kind, double irradiance_W_m2, double temperature_C,
                    std::uint64_t seed);

}  // namespace shown
