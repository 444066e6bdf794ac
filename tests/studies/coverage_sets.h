#pragma once

#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/model/translation.h"
#include "studies/coverage_options.h"

namespace lyrefit {

// A simulated set and all values drawn for it.
struct SimulatedSet {
  Translation translation;
  std::vector<double> truth;   // true shared parameters, in the translation's order
  CurveSet set;                // the curves; their conditions are those reported by the sensors
  double reference_isc_A = 0;  // Isc at 1000 W/m2 and 25 C
  // Standard deviation of every current's error. If CoverageNoise scales it with Isc, this is its
  // value at the reference conditions.
  double noise_A = 0;
};

// The translation with law, model and shunt law of the fits, for `cells_in_series` cells.
Expected<Translation> CoverageTranslation(const CoverageOptions& options, int cells_in_series);

// Simulates set number `index` of a study. Unless `options` name a module, it is drawn from these
// ranges: 36, 54, 60 or 72 cells, Isc 3 to 10 A, Voc 0.55 to 0.70 V a cell, n1 1.0 to 1.4 (two
// diodes: 1.0 to 1.2), Rs 0.5 to 3 % and Rsh 20 to 500 times Voc / Isc, alpha 0.02 to 0.08 % of Isc
// a kelvin. De Soto: Eg 1.10 to 1.14 eV. PVsyst: mu -1e-3 to 1e-3 per kelvin, dark shunt 2 to 8
// times Rsh. Two diodes: the second carries 2 to 50 % of the current at open circuit. Parameters
// that the fit fixes have the fixed values.
//
// The conditions are first five that span IEC 61853-1 (1000x25, 1000x75, 200x25, 600x50, 100x15).
// The others of its 22 follow in random order, and then the list repeats. Gaussian noise according
// to CoverageNoise is added to every current.
Expected<SimulatedSet> SimulateSet(const CoverageOptions& options, int index);

}  // namespace lyrefit
