#pragma once

#include <vector>

#include "lyrefit/certify/certify_options.h"
#include "lyrefit/law/parameter.h"

namespace lyrefit {

// What Certify() is to prove about fits within these bounds of a device: the ranges of n (of all
// diodes together) and Rs. Every model within the bounds lies within the ranges, so a lower bound
// for the ranges holds for the fits.
CertifyOptions RangesOf(const std::vector<ParameterBounds>& bounds, ConstantSet constants,
                        std::vector<Model> models);

}  // namespace lyrefit
