#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/family/pvlib_parameters.h"

namespace lyrefit {

// The parameters of the device `name` as pvlib takes them: which function, its keywords, and the
// row of SAM's library of modules, or why there is none. An infinite resistance is null.
std::string PvlibJson(const std::string& name, TranslationLaw law,
                      const std::vector<NamedValue>& keywords, const Expected<CecModule>& cec);

}  // namespace lyrefit
