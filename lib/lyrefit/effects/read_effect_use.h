// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/model/device_effects.h"

namespace LYREFIT_PUBLIC lyrefit {

// Parses "shading:d=0.3,w=0.2:0.4" into an effect of the catalogue and the values or ranges of its
// parameters. DescribeUse() is the inverse.
Expected<EffectUse> ReadEffectUse(const std::string& text);

}  // namespace lyrefit
