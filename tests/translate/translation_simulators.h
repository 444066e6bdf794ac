// Simulated devices with known curves at standard conditions. Their laws differ from those of the
// procedures, or they are modules built cell by cell (faults/field_*), with or without a fault.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/translate/device_coefficients.h"

namespace shown {

// A simulated measured curve, the data-sheet coefficients and the true key points at STC.
struct SyntheticCase {
  lyrefit::IvCurve curve;
  lyrefit::StatedCoefficients coefficients;
  lyrefit::KeyPoints stc{};
};

// Names of the simulators: "PVsyst", "two diodes", "cells".
std::vector<std::string> Worlds();
// Range of the irradiance, drawn uniformly. The cell temperature is 5 C or more.
struct Light {
  double lowest_W_m2 = 250;
  double highest_W_m2 = 1100;
};
SyntheticCase MakeReferenceSweeps(const std::string& world, const Light& light, std::uint64_t seed);

// Kinds of faults: those of faults/field_*, a shunt on every cell, and a series resistance. The
// true STC values include device faults but no sweep faults.
std::vector<std::string> FaultKinds();
SyntheticCase MakeFaulty(const std::string& kind, double irradiance_W_m2, double temperature_C,
                         std::uint64_t seed);

}  // namespace shown
