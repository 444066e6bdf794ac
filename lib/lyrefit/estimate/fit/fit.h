#pragma once

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/estimate/fit/fit_options.h"
#include "lyrefit/estimate/fit/fit_report.h"

namespace LYREFIT_PUBLIC lyrefit {

// Fits one curve by the hybrid estimator. It searches the bounds, then polishes the best candidate,
// further elites and a separable grid by bounded least squares. The report has estimates, intervals
// and diagnostics. Errors: an unusable curve, options outside their ranges, reversed or impossible
// bounds, fewer points than free parameters.
Expected<FitReport> Fit(const IvCurve& curve, const FitOptions& options = {},
                        const Observer& observer = {});

// Fits the single-, double- and triple-diode model and returns the one that the data support, with
// `choice` filled in. Another diode must improve AICc, the F-test and the held-out error, and must
// be identifiable. Errors: those of Fit().
Expected<FitReport> FitAuto(const IvCurve& curve, const FitOptions& options = {},
                            const Observer& observer = {});

}  // namespace lyrefit
