// Experimental: may change in a minor version (data/stable).
#pragma once

#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/certify/certify_options.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/estimate/fit/bounds.h"
#include "lyrefit/estimate/fit/fit_options.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/model/parameter.h"

namespace LYREFIT_PUBLIC lyrefit {

// Options of Certify() for fits of a device within `bounds`: the range of every parameter. Every
// model within the bounds is within the ranges, so a lower bound for the ranges holds for the fits.
CertifyOptions RangesOf(const std::vector<ParameterBounds>& bounds, ConstantSet constants,
                        std::vector<Model> models);

// `options` with the ranges of these bounds, for the largest of their models. Errors: bounds that
// MakeBounds() refuses; options that already have ranges.
Expected<CertifyOptions> CertifyWithin(const BoundsSpec& spec, const IvCurve& curve,
                                       const CertifyOptions& options);

// The report of a fit with these options, with the floor if `options.floor` asks for it: the lowest
// RMSE of the objective that any number of diodes within the bounds can reach. For the solved
// current the gap is closed to 1e-6 only, with a limited number of convex problems. That takes some
// seconds for 1000 readings. A report without a floor has a warning that says why: a fit that is
// not usable, more than 2000 readings of the solved current, an error of Certify(). If the observer
// stops the proof, the bound remains valid and the report is marked as interrupted.
FitReport WithFloor(FitReport report, const FitOptions& options, const Observer& observer = {});

// Fit() or, with `auto_model`, FitAuto(), then WithFloor(). Errors: those of Fit().
Expected<FitReport> FitWithFloor(const IvCurve& curve, const FitOptions& options, bool auto_model,
                                 const Observer& observer = {});

}  // namespace lyrefit
