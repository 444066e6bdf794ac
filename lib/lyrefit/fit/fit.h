#pragma once

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/fit/fit_options.h"
#include "lyrefit/fit/fit_report.h"

namespace LYREFIT_PUBLIC lyrefit {

// The hybrid estimator: search the bounds, polish the best candidate, further elites and a separable
// grid by bounded least squares, and say what is known and how well. Errors: an unusable curve,
// options outside their ranges, reversed or impossible bounds, fewer points than free parameters.
Expected<FitReport> Fit(const IvCurve& curve, const FitOptions& options = {},
                        const Observer& observer = {});

// Fits SD, DD and TD and returns the one the data support, with `choice` filled in: more diodes
// must earn their place by AICc, the F-test, identifiability and held-out error together.
Expected<FitReport> FitAuto(const IvCurve& curve, const FitOptions& options = {},
                            const Observer& observer = {});

}  // namespace lyrefit
