#pragma once

#include "lyrefit/family/family_options.h"
#include "lyrefit/family/family_report.h"

namespace lyrefit {

// Every curve of the set on its own, on all cores: the honest reference of a joint fit. The
// report's curves have free_parameters and free_rmse filled, its `estimates` are empty. Of the
// options model, objective, constants, search, fixed, bounds, with, force_effects, leave_out,
// intervals and threads count; parameter names are those of a single fit (Fit). Dark curves are
// fitted too.
Expected<FamilyReport> FitFree(const CurveSet& set, const FamilyOptions& options = {},
                               const Observer& observer = {});

}  // namespace lyrefit
