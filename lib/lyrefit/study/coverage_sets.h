#pragma once

#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/law/translation.h"
#include "lyrefit/study/coverage_options.h"

namespace lyrefit {

// A set with everything that was drawn for it.
struct SimulatedSet {
  Translation translation;
  std::vector<double> truth;   // shared parameters in the translation's order
  CurveSet set;                // conditions as the sensors read them
  double reference_isc_A = 0;  // at 1000 W/m2 and 25 C
  double noise_A = 0;  // standard deviation of every current's error; in proportion to its curve's
                       // Isc where CoverageNoise says so, then at the reference
};

// Law, model and shunt law of the fits; a module of `cells_in_series` cells.
Expected<Translation> CoverageTranslation(const CoverageOptions& options, int cells_in_series);

// Set number `index` of a study. The module, unless `options` name one: 36, 54, 60 or 72 cells, Isc
// 3 to 10 A, Voc 0.55 to 0.70 V a cell, n1 1.0 to 1.4 (two diodes: 1.0 to 1.2), Rs 0.5 to 3 % and
// Rsh 20 to 500 times Voc / Isc, alpha 0.02 to 0.08 % of Isc a kelvin; De Soto: Eg 1.10 to 1.14 eV;
// PVsyst: mu -1e-3 to 1e-3 per kelvin, dark shunt 2 to 8 times Rsh; two diodes: the second carries
// 2 to 50 % of the current at open circuit. Values that a fit holds are at what it holds them.
// The conditions: five that span IEC 61853-1 (1000x25, 1000x75, 200x25, 600x50, 100x15), then
// others of its 22 in random order, and from the first again. Then Gaussian noise on every current,
// as CoverageNoise says.
Expected<SimulatedSet> SimulateSet(const CoverageOptions& options, int index);

}  // namespace lyrefit
