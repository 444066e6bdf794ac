// Experimental: may change in a minor version (data/stable).
#pragma once

#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/model/translation.h"

namespace LYREFIT_PUBLIC lyrefit {

// Temperature coefficients of a device's key points at the reference conditions (1000 W/m2, 25 C),
// as data sheets state them.
struct TemperatureCoefficients {
  double alpha_sc_A_K;
  double beta_oc_V_K;
  double gamma_pmp_percent_K;  // percent of the maximum power at the reference, per K
};

// Computes the coefficients as central differences of the model's own key points, `half_step_K` on
// either side of the reference temperature. NaN for a device that gives no power.
TemperatureCoefficients CoefficientsAtReference(const Translation& translation,
                                                const std::vector<double>& shared,
                                                double half_step_K = 1);

}  // namespace lyrefit
