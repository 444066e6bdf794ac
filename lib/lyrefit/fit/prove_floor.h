#pragma once

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/certify/certify_options.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/fit/fit_report.h"

namespace lyrefit {

// Proves the floor within `ranges`, below a fit within them that has the RMSE `refined_A` in the
// same objective. For the solved current the gap is closed to 1e-6 only, with a limited number of
// convex problems. That takes some seconds for 1000 readings; long sweeps are refused. Sets
// `interrupted` if the observer stopped the proof; the bound remains valid. Errors: those of
// Certify(), and too many readings.
Expected<FloorReport> ProveFloor(const IvCurve& curve, CertifyOptions ranges, double refined_A,
                                 const Observer& observer, bool* interrupted);

}  // namespace lyrefit
