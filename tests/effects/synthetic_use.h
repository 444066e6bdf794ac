#pragma once

#include <map>
#include <string>
#include <utility>

#include "lyrefit/effects/catalogue.h"
#include "lyrefit/model/device_effects.h"

namespace lyrefit {

inline EffectUse UseOf(const char* id,
                       std::map<std::string, std::pair<double, double>> ranges = {}) {
  return {FindEffect(id), std::move(ranges)};
}

}  // namespace lyrefit
