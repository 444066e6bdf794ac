// Experimental: may change in a minor version (data/stable).
#pragma once

#include "lyrefit/base/public.h"
#include "lyrefit/family/family_options.h"
#include "lyrefit/family/family_report.h"

namespace LYREFIT_PUBLIC lyrefit {

// Fits every curve of the set individually, on all cores: the reference for a joint fit. The
// report's curves have individual_parameters and individual_rmse filled; its `estimates` are empty.
// The options model, objective, constants, search, fixed, bounds, with, force_effects, errors,
// leave_out, intervals and threads apply. Parameter names are those of a single fit (Fit). Dark
// curves are fitted too. A curve that cannot be fitted is left out, with a warning. Errors: no
// curve; an id to leave out that the set lacks; threads below 0; if no curve can be fitted, the
// error of the first.
Expected<FamilyReport> FitIndividually(const CurveSet& set, const FamilyOptions& options = {},
                                       const Observer& observer = {});

}  // namespace lyrefit
