// Experimental: may change in a minor version (data/stable).
#pragma once

#include <optional>
#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/devices/cell_report.h"

namespace LYREFIT_PUBLIC lyrefit {

// n from open-circuit voltages over light (see IdealityOverLight); none for fewer than two points.
// `module_thermal_voltage_V`: Ns k T / q. The interval of n is that of the slope of a least-squares
// line, for three points and more.
std::optional<IdealityOverLight> FindIdealityOverLight(std::vector<VocPoint> points,
                                                       double module_thermal_voltage_V);

// The points of a series of lit sweeps: one a light, the mean Isc and Voc of its sweeps. The sweeps
// are those of one file and direction where one has every light, else all.
std::vector<VocPoint> PointsOfLights(const std::vector<CellSweep>& sweeps);
// The points of a Suns-Voc trace, without those in the dark.
std::vector<VocPoint> PointsOfTrace(const CellSweep& sweep);

// Voc at a light, linear in the logarithm of the light between points; NaN outside them.
double VocAt(const std::vector<VocPoint>& points, double light_A);

// Local ideality of a dark curve without its shunt current, V times the slope at 0 V of the readings
// with |V| <= 25 mV per cell (at least three). Slopes of ln J are of the readings within 50 mV per
// cell, at least five. A reading counts if J without the shunt is above half of J and above ten
// times the noise. NaN where there are none.
DarkIdeality FindDarkIdeality(const CellSweep& dark, double module_thermal_voltage_V, int cells);

}  // namespace lyrefit
