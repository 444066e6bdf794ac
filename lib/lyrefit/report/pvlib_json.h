#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/family/pvlib_parameters.h"

namespace lyrefit {

// The parameters of the device `name` as pvlib takes them: which function, its keywords and no
// others, so that function(1000, 25, **parameters) can be called, and the row of SAM's library of
// modules, or why there is none. cells_in_series stands beside them (calcparams_pvsyst takes it as
// well), d2mutau and NsVbi are those of pvlib's bishop88 functions. An infinite resistance is null.
std::string PvlibJson(const std::string& name, TranslationLaw law,
                      const std::vector<NamedValue>& keywords, const Expected<CecModule>& cec);

}  // namespace lyrefit
