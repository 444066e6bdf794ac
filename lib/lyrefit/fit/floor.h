#pragma once

#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/certify/certify_options.h"
#include "lyrefit/fit/bounds.h"
#include "lyrefit/law/parameter.h"

namespace LYREFIT_PUBLIC lyrefit {

// Options of Certify() for fits of a device within `bounds`: the range of every parameter. Every
// model within the bounds is within the ranges, so a lower bound for the ranges holds for the fits.
CertifyOptions RangesOf(const std::vector<ParameterBounds>& bounds, ConstantSet constants,
                        std::vector<Model> models);

// `options` with the ranges of these bounds, for the largest of their models. Errors: bounds that
// MakeBounds() refuses; options that already have ranges.
Expected<CertifyOptions> CertifyWithin(const BoundsSpec& spec, const IvCurve& curve,
                                       const CertifyOptions& options);

}  // namespace lyrefit
