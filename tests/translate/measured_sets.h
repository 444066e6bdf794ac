// Measured sweeps of one healthy module under many conditions.
#pragma once

#include <string>
#include <vector>

#include "translate/carried.h"

namespace shown {

// The irradiance of all sets is derived from the curve's own Isc, so the sets test the translation,
// not the sensor. In the first set the index does so itself and agrees with Isc to 0.1 %. In the
// others the logged irradiance is not of the sweep's time or plane. The temperature of the second
// and third set follows from Voc, beta and the Voc of a diode over irradiance, as no temperature of
// the sweep's time exists.
struct MeasuredSet {
  std::string name;
  std::vector<lyrefit::IvCurve> curves;
  lyrefit::TranslateOptions options;
};

// Crystalline silicon, 36 cells; alpha and beta as stated in the set. Keeps every `every`-th curve.
lyrefit::Expected<MeasuredSet> SandiaSet(const std::string& data, int every);
// Mono-crystalline silicon, 60 cells, two days; voltages in bins of 0.34 V. The temperature depends
// on the ideality, which is not known, so the results depend on it too.
struct NistDay {
  std::string day;
  double ideality = 1.1;
};
lyrefit::Expected<MeasuredSet> NistSet(const std::string& data, const NistDay& of, int every);

// Sweeps with a single-diode RMSE below half a per cent of Isc, which had steady light.
std::vector<Sweep> Steady(std::vector<Sweep> sweeps);

// Relative standard deviation of Pmax of one sweep, from pairs in similar conditions (2 % of
// irradiance, 1 K). It contains the errors of irradiance and temperature, the atmosphere and the
// instrument, but not the procedure.
double LikeScatter(const std::vector<Sweep>& sweeps);

// Assigns the scatter of both sweeps to the irradiance, to which Pmax is proportional.
Conditions ConditionsOf(double like_scatter);

}  // namespace shown
