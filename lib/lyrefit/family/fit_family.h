#pragma once

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/family/family_options.h"
#include "lyrefit/family/family_report.h"
#include "lyrefit/law/translation.h"

namespace LYREFIT_PUBLIC lyrefit {

// Fits one set of reference parameters to all light curves of a set: MLO over the shared parameters
// on a few well-spread curves, then one bounded least-squares problem with shared and per-curve
// unknowns on all of them. A curve whose irradiance or temperature nobody stated gets it as an
// unknown of its own. Errors: fewer than two light curves, options outside their ranges, unknown
// names.
Expected<FamilyReport> FitFamily(const CurveSet& set, const FamilyOptions& options = {},
                                 const Observer& observer = {});

// What FitFamily() would object to before its search, and else the law that it would fit.
Expected<Translation> CheckFamily(const CurveSet& set, const FamilyOptions& options);

// De Soto and PVsyst with one and two diodes on the same curves, with `candidates` filled in. Of
// the laws whose error on held-out curves is within one standard error of the lowest, the one with
// the fewest free parameters is reported.
Expected<FamilyReport> FitFamilyAuto(const CurveSet& set, const FamilyOptions& options = {},
                                     const Observer& observer = {});

}  // namespace lyrefit
