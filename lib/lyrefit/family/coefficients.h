#pragma once

#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/law/translation.h"

namespace LYREFIT_PUBLIC lyrefit {

// How a device's key points follow the cell temperature at the reference (1000 W/m2, 25 C), as data
// sheets state it.
struct TemperatureCoefficients {
  double alpha_sc_A_K;
  double beta_oc_V_K;
  double gamma_pmp_percent_K;  // of the maximum power at the reference
};

// Central differences over `half_step_K` on either side, of the model's own curves; NaN for a
// device that gives no power.
TemperatureCoefficients CoefficientsAtReference(const Translation& translation,
                                                const std::vector<double>& shared,
                                                double half_step_K = 1);

}  // namespace lyrefit
