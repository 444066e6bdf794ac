// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/model/device_effects.h"
#include "lyrefit/model/effect.h"

namespace LYREFIT_PUBLIC lyrefit {

// All effects, in the order of reports. To add one: a file effects/<id>.cc with a function that
// returns it, and its line in parts.h.
const std::vector<const Effect*>& Catalogue();

// Default values of clip's limits, which mean no limit (current scales).
constexpr double kNoUpperLimit = 1.5;
constexpr double kNoLowerLimit = -50;

// The effect with this id, nullptr if there is none.
const Effect* FindEffect(const std::string& id);

// A measurement error that current-voltage data cannot separate from the parameters it biases. It
// is never named as a cause.
struct Inseparable {
  const char* id;      // "lead_resistance"
  const char* biases;  // "Rs"
  const char* sentence;
  const char* separate_by;
  bool (*applies)(const DataTraits&);  // whether such data cannot separate it
};
const std::vector<Inseparable>& InseparableCauses();

// Parses "shading:d=0.3,w=0.2:0.4" into an effect of the catalogue and the values or ranges of its
// parameters. DescribeUse() is the inverse.
Expected<EffectUse> ReadEffectUse(const std::string& text);

}  // namespace lyrefit
