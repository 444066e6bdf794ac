// Experimental: may change in a minor version (data/stable).
#pragma once

#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/model/reading.h"

namespace LYREFIT_PUBLIC lyrefit {

// A lit curve between short and open circuit, current over voltage, without a model. Up and down
// sweeps are merged.
struct CurveShape {
  double open_circuit = 0;      // per cell, V
  std::vector<double> current;  // in current scales, at equal voltage steps from 0 to Voc

  // Current at `part` (0 to 1) of the open-circuit voltage, in current scales.
  double At(double part) const;
};

// A place where a curve is flatter than on either side: a light that limits the current.
struct Plateau {
  double place = 0;    // in parts of the open-circuit voltage
  double current = 0;  // there, in current scales
};

// The plateaus of a curve, from short circuit on, and the places of the steps after each. The last
// step is the knee before open circuit. A plateau is half as steep as the steps beside it.
struct Stairs {
  std::vector<Plateau> plateaus;
  std::vector<double> steps;  // in parts of the open-circuit voltage
};
Stairs StairsOf(const CurveShape& shape);

// Curve of all lit readings, smoothed by a running median of five, which keeps steps sharp. Empty
// for fewer than two lit readings.
CurveShape ShapeOf(const Readings& readings);

}  // namespace lyrefit
