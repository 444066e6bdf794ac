#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/curve/check_readings.h"
#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// Sizes that no device has, mostly of a unit gone wrong. The readings can be worked with, but no
// answer that depends on their size can be believed. None of these findings refuses. CheckReadings
// has them among its own, so that every verb says them:
//   current   Isc, brought to 1000 W/m2 where the irradiance is stated, above 100 A a string, or
//             above 70 mA/cm2 where the area of a cell is stated; below 20 mA a string of 30 cells
//             or more, from a stated 100 W/m2 on
//   shape     a fill factor above 0.95 or below 0.1
std::vector<ReadingFinding> CheckPlausibility(const IvCurve& curve);

// Why nobody should believe an answer about this curve: Pmax above 3 times or below 1/300 of the
// rated power of the whole device (the lower one in proportion to the irradiance, from 200 W/m2
// on), else the first finding of CheckPlausibility. None: nothing is implausible.
std::optional<std::string> PlausibilityProblem(const IvCurve& curve,
                                       std::optional<double> rated_power_W = std::nullopt);

}  // namespace lyrefit
