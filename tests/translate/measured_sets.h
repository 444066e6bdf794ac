// Measured sweeps of one healthy module under many conditions, with what of their conditions can be
// trusted.
#pragma once

#include <string>
#include <vector>

#include "translate/carried.h"

namespace shown {

// The light of all sets is the curve's own Isc (of the first the index says so itself, it agrees with
// Isc to 0.1 %; of the others the logged light is not of the sweep's moment or plane): what is tried
// is the step, not the sensor. The temperature of the second and third is read off Voc, by beta and
// a diode's Voc in the light: there is no other that is of the moment.
struct MeasuredSet {
  std::string name;
  std::vector<lyrefit::IvCurve> curves;
  lyrefit::TranslateOptions options;
};

// Of crystalline silicon, 36 cells; alpha and beta as the set states them.
lyrefit::Expected<MeasuredSet> SandiaSet(const std::string& data, int every);
// Of mono-crystalline silicon, 60 cells, two days; voltages in bins of 0.34 V.
// The ideality behind the temperature is not known: the figures depend on it.
struct NistDay {
  std::string day;
  double ideality = 1.1;
};
lyrefit::Expected<MeasuredSet> NistSet(const std::string& data, const NistDay& of, int every);

// The sweeps that a single diode misses by less than half a per cent of Isc: the light stood still.
std::vector<Sweep> Steady(std::vector<Sweep> sweeps);

// What sweeps in like conditions (2 % of light, 1 K) differ by in Pmax, parts, standard deviation of
// one: light and temperature as wrong as they are, air, instrument. No procedure's doing.
double LikeScatter(const std::vector<Sweep>& sweeps);

// Both ends are doubted by it. It stands as light, in proportion to which Pmax goes.
Conditions ConditionsOf(double like_scatter);

}  // namespace shown
