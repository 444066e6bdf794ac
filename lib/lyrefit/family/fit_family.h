// Experimental: may change in a minor version (data/stable).
#pragma once

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/family/family_options.h"
#include "lyrefit/family/family_report.h"
#include "lyrefit/model/translation.h"

namespace LYREFIT_PUBLIC lyrefit {

// Fits one set of reference parameters to all light curves of a set. MLO searches the shared
// parameters on a few well-spread curves. One bounded least-squares problem then fits shared and
// per-curve unknowns to all curves. An irradiance or temperature that a curve does not state
// becomes an unknown of that curve. Errors: fewer than two light curves, options outside their
// ranges, unknown names.
Expected<FamilyReport> FitFamily(const CurveSet& set, const FamilyOptions& options = {},
                                 const Observer& observer = {});

// Checks the set and the options as FitFamily() does before its search. Returns the law to be
// fitted.
Expected<Translation> CheckFamily(const CurveSet& set, const FamilyOptions& options);

// Fits De Soto and PVsyst with one and two diodes to the same curves and fills `candidates`.
// Reports the law with the fewest free parameters among those whose error on held-out curves is
// within one standard error of the lowest.
Expected<FamilyReport> FitFamilyAuto(const CurveSet& set, const FamilyOptions& options = {},
                                     const Observer& observer = {});

}  // namespace lyrefit
