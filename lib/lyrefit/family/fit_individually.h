#pragma once

#include "lyrefit/base/public.h"
#include "lyrefit/family/family_options.h"
#include "lyrefit/family/family_report.h"

namespace LYREFIT_PUBLIC lyrefit {

// Every curve of the set on its own, on all cores: the honest reference of a joint fit. The
// report's curves have free_parameters and individual_rmse filled, its `estimates` are empty. Of the
// options model, objective, constants, search, fixed, bounds, with, force_effects, leave_out,
// intervals and threads count; parameter names are those of a single fit (Fit). Dark curves are
// fitted too. A curve that cannot be fitted is left out, with a warning. Errors: no curve, one to be
// left out that is not there, threads below 0, and where no curve can be fitted why the first cannot.
Expected<FamilyReport> FitIndividually(const CurveSet& set, const FamilyOptions& options = {},
                               const Observer& observer = {});

}  // namespace lyrefit
