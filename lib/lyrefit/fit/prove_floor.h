#pragma once

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/certify/certify_options.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/fit/fit_report.h"

namespace lyrefit {

// The floor within these ranges, below a fit within them whose RMSE of the same objective is
// `refined_A`. Of the solved current it is closed to 1e-6 only, in few convex problems, and not asked
// for of long sweeps: some seconds of 1000 readings. Sets `interrupted` where the observer ended it;
// the bound holds all the same. Errors: those of Certify(), and too many readings.
Expected<FloorReport> ProveFloor(const IvCurve& curve, CertifyOptions ranges, double refined_A,
                                 const Observer& observer, bool* interrupted);

}  // namespace lyrefit
