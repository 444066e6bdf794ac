#pragma once

#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/law/reading.h"

namespace LYREFIT_PUBLIC lyrefit {

// A lit curve as it looks, without a model: current over voltage between short and open circuit,
// sweeps up and down taken together.
struct CurveShape {
  double open_circuit = 0;      // per cell, V
  std::vector<double> current;  // at equal steps of the voltage from 0 to open circuit, in scales

  // At a part of the open-circuit voltage, 0 to 1.
  double At(double part) const;
};

// Smoothed by medians, which keep steps where they are.
CurveShape ShapeOf(const Readings& readings);

}  // namespace lyrefit
