#pragma once

#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// Prior of the departure of a device from a law that has the right causes: ln of the size of the
// rough path (estimate/refine/error_model.h) is normal.
struct DeparturePrior {
  double center = 0;  // in current scales; 0: none, the law is exact
  double width = 0;   // standard deviation of the logarithm; 0: the size is stated
};

// ln of the marginal likelihood of the readings under a law: the likelihood times the priors of the
// parameters, integrated over them by Laplace's approximation at the fit and over the size of the
// path on a grid. Differences are comparable between laws on the same readings and sigma.
struct LogEvidence {
  double complete = -HUGE_VAL;  // the departure has its prior
  // Something else bends the curve as well: the departure is larger, by an unknown factor.
  double incomplete = -HUGE_VAL;
  double path = 0;  // most probable size of the path in the complete case, in scales
};

// `fit`: an optimum of its law. Parameters at bounds count with the part of their likelihood that
// lies inside. Kass and Raftery 1995, doi:10.1080/01621459.1995.10476572; the integral over the
// parameters is that of the restricted likelihood (doi:10.1093/biomet/58.3.545).
LogEvidence FindLogEvidence(const WeightedData& weighted, const LawFit& fit,
                            const DeparturePrior& departure);

// ln(exp a + exp b).
double LogSum(double a, double b);

}  // namespace lyrefit
