// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/diagnose/diagnose_options.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/read/read_curve.h"

namespace LYREFIT_PUBLIC lyrefit {

// Finds systematic deviations of the data from the base model, their causes, and the gain of
// modelling them. The set holds one curve (one sweep, or up and down), a lit and a dark curve
// (irradiance 0), or a family over irradiance and temperature. The points of each curve are in the
// order of measurement.
//
// Errors: an unusable curve, options outside their ranges, unknown effect ids, own effects that
// cannot be fitted, fewer than 7 readings, readings that no diode model fits.
Expected<Diagnosis> Diagnose(const CurveSet& taken, const DiagnoseOptions& options = {},
                             const Observer& observer = {});
Expected<Diagnosis> Diagnose(const IvCurve& curve, const DiagnoseOptions& options = {},
                             const Observer& observer = {});

}  // namespace lyrefit
